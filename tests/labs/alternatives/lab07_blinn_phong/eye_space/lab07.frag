precision highp float;
uniform mat4 u_ViewMatrix;
uniform vec3 u_LightColor[2], u_LightPosition[2];
uniform vec3 u_AmbientLight, u_SpecularColor;
uniform float u_Shininess;
varying vec3 v_EyePosition, v_EyeNormal;
varying vec4 v_Color;
const float FACTOR = 4.0, MORE = 1.27;
void main() {
    vec3 n = normalize(v_EyeNormal);
    vec3 v = -normalize(v_EyePosition);
    vec3 c = u_AmbientLight * v_Color.rgb;
    for (int i = 0; i < 2; i++) {
        vec3 l = normalize((u_ViewMatrix * vec4(u_LightPosition[i], 1.0)).xyz - v_EyePosition);
        vec3 h = normalize(l + v);
        float nl = max(dot(n, l), 0.0);
        c += u_LightColor[i] * v_Color.rgb * nl;
        if (nl > 0.0)
            c += u_LightColor[i] * u_SpecularColor * pow(max(dot(n, h), 0.0), FACTOR * u_Shininess + MORE);
    }
    gl_FragColor = vec4(c, v_Color.a);
}
