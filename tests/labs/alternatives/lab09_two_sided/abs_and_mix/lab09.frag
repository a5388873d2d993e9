#version 100
precision highp float;
uniform vec3 u_LightColor;
uniform vec3 u_LightPosition;
uniform vec3 u_AmbientLight;
uniform vec3 u_EyePosition;
uniform vec4 u_BackColor;
varying vec3 v_Position;
varying vec3 v_Normal;
varying vec4 v_Color;
void main() {
    vec3 v = normalize(u_EyePosition - v_Position);
    vec3 n = faceforward(normalize(v_Normal), -v, v_Normal); // towards the eye
    float k = dot(v_Normal, v) < 0.0 ? 1.0 : 0.0;
    vec3 base = mix(v_Color, u_BackColor, k).rgb;
    vec3 l = normalize(u_LightPosition - v_Position);
    gl_FragColor = vec4(base * u_AmbientLight + base * u_LightColor * clamp(dot(l, n), 0.0, 1.0), 1.0);
}
