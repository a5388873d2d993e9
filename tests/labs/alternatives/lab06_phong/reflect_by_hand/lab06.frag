precision highp float;
uniform vec3 u_LightColor[2], u_LightPosition[2];
uniform vec3 u_AmbientLight, u_SpecularColor, u_EyePosition;
uniform float u_Shininess;
varying vec3 v_Position, v_Normal;
varying vec4 v_Color;
void main() {
    vec3 N = normalize(v_Normal);
    vec3 V = normalize(u_EyePosition - v_Position);
    vec3 sum = u_AmbientLight * v_Color.rgb;
    for (int i = 0; i < 2; i++) {
        vec3 L = normalize(u_LightPosition[i] - v_Position);
        float NL = max(dot(N, L), 0.0);
        vec3 R = 2.0 * NL * N - L;
        float RV = max(dot(R, V), 0.0);
        float specular = NL > 0.0 ? pow(RV, u_Shininess) : 0.0;
        sum += u_LightColor[i] * (v_Color.rgb * NL + u_SpecularColor * specular);
    }
    gl_FragColor = vec4(sum, v_Color.a);
}
