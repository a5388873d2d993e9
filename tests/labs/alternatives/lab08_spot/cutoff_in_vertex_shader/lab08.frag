precision highp float;
uniform vec3 u_LightColor, u_SpotDirection, u_Attenuation;
uniform vec3 u_AmbientLight, u_SpecularColor;
uniform float u_SpotExponent, u_Shininess;
varying vec3 toLight, toEye, normal;
varying vec4 color;
varying float cosCutoff;
void main() {
    vec3 N = normalize(normal), L = normalize(toLight), V = normalize(toEye);
    float d2 = dot(toLight, toLight);
    float att = 1.0 / (u_Attenuation.x + u_Attenuation.y * sqrt(d2) + u_Attenuation.z * d2);
    float s = -dot(L, u_SpotDirection);
    float spot = s < cosCutoff ? 0.0 : pow(s, u_SpotExponent);
    float diff = max(dot(N, L), 0.0);
    float spec = diff > 0.0 ? pow(max(dot(2.0 * dot(N, L) * N - L, V), 0.0), u_Shininess) : 0.0;
    vec3 light = att * spot * u_LightColor;
    gl_FragColor = vec4(color.rgb * (u_AmbientLight + light * diff) + light * u_SpecularColor * spec, color.a);
}
