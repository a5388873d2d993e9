attribute vec4 a_Position;
attribute vec4 a_Normal;
attribute vec4 a_Color;
uniform mat4 u_MvpMatrix, u_ModelMatrix, u_NormalMatrix;
uniform vec3 u_LightPosition[2];
varying vec3 v_N;
varying vec3 v_ToLight0, v_ToLight1; // not unit: interpolates exactly
varying vec3 v_Kd;
void main() {
    vec3 world = vec3(u_ModelMatrix * vec4(a_Position.xyz, 1.0));
    v_ToLight0 = u_LightPosition[0] - world;
    v_ToLight1 = u_LightPosition[1] - world;
    v_N = vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0));
    v_Kd = a_Color.rgb;
    gl_Position = u_MvpMatrix * a_Position;
}
