attribute vec4 a_Position;
attribute vec4 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
uniform float u_SpotCutoff;
uniform vec3 u_LightPosition;
uniform vec3 u_EyePosition;
varying vec3 toLight, toEye, normal;
varying vec4 color;
varying float cosCutoff;
const float PI = 3.14159265358979;
void main() {
    vec3 world = vec3(u_ModelMatrix * a_Position);
    toLight = u_LightPosition - world;
    toEye = u_EyePosition - world;
    normal = vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0));
    color = a_Color;
    cosCutoff = cos(u_SpotCutoff * PI / 180.0);
    gl_Position = u_MvpMatrix * a_Position;
}
