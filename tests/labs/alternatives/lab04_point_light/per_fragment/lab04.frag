precision highp float;
uniform vec3 u_LightColor[2], u_LightPosition[2], u_AmbientLight;
varying vec4 v_Color;
varying vec3 v_Normal, v_Position;
void main() {
    vec3 n = normalize(v_Normal);
    vec3 l0 = normalize(u_LightPosition[0] - v_Position);
    vec3 l1 = normalize(u_LightPosition[1] - v_Position);
    vec3 e = u_LightColor[0] * max(dot(n, l0), 0.0) + u_LightColor[1] * max(dot(n, l1), 0.0);
    gl_FragColor = vec4((e + u_AmbientLight) * v_Color.rgb, 1.0);
}
