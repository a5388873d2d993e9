attribute vec3 a_Position;
attribute vec3 a_Color;
attribute vec3 a_Normal;
uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
varying vec3 v_irradiance;
varying vec3 v_albedo;
void main() {
    vec3 p = (u_ModelMatrix * vec4(a_Position, 1.0)).xyz;
    vec3 n = normalize((u_NormalMatrix * vec4(a_Normal, 0.0)).xyz);
    v_irradiance = vec3(0.0);
    int i = 0;
    for (int k = 0; k < 2; k++) {
        vec3 d = u_LightPosition[k] - p;
        v_irradiance += max(dot(n, d) / length(d), 0.0) * u_LightColor[k];
    }
    v_albedo = a_Color;
    gl_Position = u_MvpMatrix * vec4(a_Position, 1.0);
}
