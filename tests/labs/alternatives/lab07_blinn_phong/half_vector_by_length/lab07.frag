#version 100
precision highp float;
#define SHININESS (u_Shininess * 4.0 + 1.3)
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition;
varying vec3 P;
varying vec3 N_;
varying vec4 C;
vec3 shade(vec3 N, vec3 V, vec3 L, vec3 color) {
    float NdotL = dot(N, L);
    if (!(NdotL > 0.0)) return vec3(0.0, 0.0, 0.0);
    vec3 H = L + V;
    float NdotH = dot(N, H) / length(H);
    return color * (C.rgb * NdotL + u_SpecularColor * (NdotH > 0.0 ? exp(SHININESS * log(NdotH)) : 0.0));
}
void main() {
    vec3 N = normalize(N_);
    vec3 V = normalize(u_EyePosition - P);
    vec3 sum = shade(N, V, normalize(u_LightPosition[0] - P), u_LightColor[0]);
    sum = sum + shade(N, V, normalize(u_LightPosition[1] - P), u_LightColor[1]);
    sum = sum + u_AmbientLight * C.rgb;
    gl_FragColor = vec4(sum, C.a);
}
