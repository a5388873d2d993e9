precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_AmbientLight;
uniform vec4 u_BackColor;
uniform float u_Mirrored;
varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position;
void main() {
    bool mirrored = u_Mirrored == -1.0;
    bool back = !gl_FrontFacing ^^ mirrored;
    vec3 N = normalize(v_Normal) * (back ? -1.0 : 1.0);
    vec3 kd = back ? u_BackColor.rgb : v_Color.rgb;
    vec3 L = u_LightPosition - v_Position;
    L *= inversesqrt(dot(L, L));
    vec3 rgb = kd * u_AmbientLight;
    rgb += max(0.0, dot(L, N)) * kd * u_LightColor;
    gl_FragColor = vec4(rgb, 1.0);
}
