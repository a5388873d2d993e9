// All in the object's own space but for the normal's: positions are moved there and back.
attribute vec4 a_Position;
attribute vec4 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
varying vec4 v_Color;
varying vec4 v_Model;
varying vec3 v_ModelNormal;
void main() {
    gl_Position = u_MvpMatrix * a_Position;
    v_Model = a_Position;
    v_ModelNormal = a_Normal.xyz;
    v_Color = a_Color;
}
