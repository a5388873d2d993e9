attribute vec4 a_Position, a_Color, a_Normal;
uniform mat4 u_ModelViewMatrix, u_ProjMatrix, u_ViewMatrix, u_EyeNormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
varying vec4 v_Color;
void main() {
    vec4 P = u_ModelViewMatrix * a_Position;
    vec3 N = normalize(vec3(u_EyeNormalMatrix * vec4(a_Normal.xyz, 0.0)));
    vec3 sum = u_AmbientLight;
    for (int i = 0; i < 2; i++) {
        vec4 light = u_ViewMatrix * vec4(u_LightPosition[i], 1.0);
        sum += u_LightColor[i] * max(dot(N, normalize(light.xyz - P.xyz)), 0.0);
    }
    v_Color = vec4(sum, 1.0) * a_Color;
    gl_Position = u_ProjMatrix * P;
}
