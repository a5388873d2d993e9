precision highp float;
uniform vec3 u_LightColor[2];
uniform vec3 u_AmbientLight;
varying vec3 v_N;
varying vec3 v_ToLight0, v_ToLight1;
varying vec3 v_Kd;
void main() {
    vec3 n = normalize(v_N);
    float d0 = max(0.0, dot(n, normalize(v_ToLight0)));
    float d1 = max(0.0, dot(n, normalize(v_ToLight1)));
    vec3 color = v_Kd * (u_AmbientLight + u_LightColor[0] * d0 + u_LightColor[1] * d1);
    gl_FragColor = vec4(clamp(color, 0.0, 1.0), 1.0);
}
