// The exponents were measured, with PhongBlinn, for 4, 8, 16 and 30; between them I interpolate.
precision highp float;
uniform vec3 u_LightColor[2], u_LightPosition[2];
uniform vec3 u_AmbientLight, u_SpecularColor, u_EyePosition;
uniform float u_Shininess;
varying vec3 v_Position, v_Normal;
varying vec4 v_Color;

float fitted(float s) {
    if (s < 8.0) return mix(17.36, 33.31, (s - 4.0) / 4.0);
    if (s < 16.0) return mix(33.31, 65.28, (s - 8.0) / 8.0);
    return mix(65.28, 121.26, (s - 16.0) / 14.0);
}

void main() {
    vec3 n = normalize(v_Normal), v = normalize(u_EyePosition - v_Position);
    float m = fitted(u_Shininess);
    vec3 c = u_AmbientLight * v_Color.rgb;
    for (int i = 0; i < 2; ++i) {
        vec3 l = normalize(u_LightPosition[i] - v_Position);
        vec3 h = normalize(l + v);
        float nl = max(dot(n, l), 0.0), nh = max(dot(n, h), 0.0);
        c += u_LightColor[i] * (v_Color.rgb * nl + u_SpecularColor * pow(nh, m) * float(nl > 0.0));
    }
    gl_FragColor = vec4(c, 1.0);
}
