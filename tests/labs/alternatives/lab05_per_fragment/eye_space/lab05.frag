precision highp float;
uniform mat4 u_ViewMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
varying vec3 v_EyePosition;
varying vec3 v_EyeNormal;
varying vec4 v_Color;
void main() {
    vec3 n = normalize(v_EyeNormal);
    vec3 c = u_AmbientLight;
    for (int i = 0; i < 2; i++) {
        vec3 light = (u_ViewMatrix * vec4(u_LightPosition[i], 1.0)).xyz;
        c += u_LightColor[i] * max(dot(n, normalize(light - v_EyePosition)), 0.0);
    }
    gl_FragColor = vec4(c, 1.0) * v_Color;
}
