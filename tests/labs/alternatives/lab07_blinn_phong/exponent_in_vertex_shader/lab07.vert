attribute vec4 a_Position, a_Normal, a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
uniform float u_Shininess;
varying vec4 v_Color;
varying vec3 v_Normal, v_Position;
varying float v_Exponent;
void main() {
    v_Exponent = 4.0 * u_Shininess + 1.25 + 0.4 / u_Shininess;
    v_Position = vec3(u_ModelMatrix * a_Position);
    v_Normal = vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0));
    v_Color = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
