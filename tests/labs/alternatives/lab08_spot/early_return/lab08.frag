#version 100
precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_SpotDirection, u_Attenuation;
uniform float u_SpotCutoff, u_SpotExponent, u_Shininess;
uniform vec3 u_AmbientLight, u_SpecularColor, u_EyePosition;

varying vec3 q;
varying vec3 n;
varying vec4 c;
void main() {
    vec3 toLight = u_LightPosition - q;
    vec3 L = normalize(toLight);
    gl_FragColor = vec4(u_AmbientLight * c.rgb, 1.0);
    float cosAngle = dot(L, -u_SpotDirection);
    if (cosAngle < cos(u_SpotCutoff * 0.0174532925)) return; // outside the cone
    vec3 N = normalize(n);
    float NL = dot(N, L);
    if (NL <= 0.0) return; // behind
    float r = length(toLight);
    vec3 I = u_LightColor * pow(cosAngle, u_SpotExponent);
    I /= u_Attenuation.x + r * u_Attenuation.y + r * r * u_Attenuation.z;
    vec3 R = reflect(-L, N);
    vec3 V = normalize(u_EyePosition - q);
    gl_FragColor.rgb += I * c.rgb * NL;
    gl_FragColor.rgb += I * u_SpecularColor * pow(max(dot(R, V), 0.0), u_Shininess);
}
