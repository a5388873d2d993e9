precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_AmbientLight, u_EyePosition;
uniform vec4 u_BackColor;
varying vec3 v_P, v_N;
varying vec4 v_Front;
void main() {
    vec3 n = normalize(v_N);
    vec3 l = normalize(u_LightPosition - v_P);
    vec3 v = u_EyePosition - v_P;
    bool front = dot(n, v) > 0.0;
    vec4 c = front ? v_Front : u_BackColor;
    float d = max(front ? dot(n, l) : -dot(n, l), 0.0);
    gl_FragColor = vec4(c.rgb * (u_AmbientLight + d * u_LightColor), c.a);
}
