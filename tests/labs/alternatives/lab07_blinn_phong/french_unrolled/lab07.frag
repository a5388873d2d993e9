precision highp float;
// éclairage par fragment
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition;
varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position;
void main() {
    vec3 n = normalize(v_Normal);
    vec3 oeil = normalize(u_EyePosition - v_Position);
    vec3 l1 = normalize(u_LightPosition[0] - v_Position);
    vec3 l2 = normalize(u_LightPosition[1] - v_Position);
    vec3 demi1 = normalize(oeil + l1);
    vec3 demi2 = normalize(oeil + l2);
    float e = 4.0 * (u_Shininess + 0.32);
    float d1 = max(dot(n, l1), 0.0), d2 = max(dot(n, l2), 0.0);
    float s1 = 0.0, s2 = 0.0;
    if (d1 > 0.0) s1 = pow(max(dot(n, demi1), 0.0), e);
    if (d2 > 0.0) s2 = pow(max(dot(n, demi2), 0.0), e);
    vec3 c = v_Color.rgb * (u_AmbientLight + d1 * u_LightColor[0] + d2 * u_LightColor[1]);
    c += u_SpecularColor * (s1 * u_LightColor[0] + s2 * u_LightColor[1]);
    gl_FragColor = vec4(c, v_Color.a);
}
