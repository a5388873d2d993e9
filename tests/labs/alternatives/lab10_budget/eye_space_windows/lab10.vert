attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec3 a_Normal;
uniform mat4 u_ModelViewMatrix, u_EyeNormalMatrix, u_ProjMatrix, u_ViewMatrix;
uniform vec3 u_LightPosition;
varying vec3 toEye, toLight, normal;
varying vec4 color;
void main() {
    vec4 eye = u_ModelViewMatrix * a_Position;
    toEye = -eye.xyz;
    toLight = (u_ViewMatrix * vec4(u_LightPosition, 1.0)).xyz - eye.xyz;
    normal = mat3(u_EyeNormalMatrix) * a_Normal;
    color = a_Color;
    gl_Position = u_ProjMatrix * eye;
}
