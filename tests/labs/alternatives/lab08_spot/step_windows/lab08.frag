precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_SpotDirection, u_Attenuation;
uniform float u_SpotCutoff, u_SpotExponent, u_Shininess;
uniform vec3 u_AmbientLight, u_SpecularColor, u_EyePosition;
varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position;
void main(void)
{
    vec3 N = normalize(v_Normal);
    vec3 L = normalize(u_LightPosition - v_Position);
    vec3 V = normalize(u_EyePosition - v_Position);
    vec3 R = normalize(reflect(-L, N));
    float r = length(u_LightPosition - v_Position);
    float cosA = max(dot(-L, u_SpotDirection), 0.0);
    float inside = step(cos(radians(u_SpotCutoff)), cosA);
    float k = inside * pow(cosA, u_SpotExponent) / (u_Attenuation.x + u_Attenuation.y * r + u_Attenuation.z * r * r);
    float front = dot(N, L) > 0.0 ? 1.0 : 0.0;
    vec3 ambient = u_AmbientLight * v_Color.rgb;
    vec3 diffuse = k * front * dot(N, L) * u_LightColor * v_Color.rgb;
    vec3 specular = k * front * pow(max(dot(R, V), 0.0), u_Shininess) * u_LightColor * u_SpecularColor;
    gl_FragColor = vec4(ambient + diffuse + specular, v_Color.a);
}
