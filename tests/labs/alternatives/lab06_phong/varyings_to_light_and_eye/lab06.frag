precision highp float;
uniform vec3 u_LightColor[2], u_AmbientLight, u_SpecularColor;
uniform float u_Shininess;
varying vec3 v_Normal, v_ToEye, v_ToLight[2];
varying vec4 v_Color;
vec3 oneLight(vec3 L, vec3 N, vec3 V, vec3 color) {
    float d = dot(N, L);
    if (d <= 0.0) return vec3(0);
    return color * (d * v_Color.xyz + pow(clamp(dot(2.0 * d * N - L, V), 0.0, 1.0), u_Shininess) * u_SpecularColor);
}
void main() {
    vec3 N = normalize(v_Normal), V = normalize(v_ToEye);
    vec3 c = v_Color.xyz * u_AmbientLight;
    c += oneLight(normalize(v_ToLight[0]), N, V, u_LightColor[0]);
    c += oneLight(normalize(v_ToLight[1]), N, V, u_LightColor[1]);
    gl_FragColor = vec4(c, 1);
}
