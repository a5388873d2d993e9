precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_SpotDirection, u_Attenuation;
uniform float u_SpotCutoff, u_SpotExponent, u_Shininess;
uniform vec3 u_AmbientLight, u_SpecularColor, u_EyePosition;

varying vec3 v_Position, v_Normal;
varying vec4 v_Color;
void main() {
    vec3 n = normalize(v_Normal);
    vec3 l = normalize(u_LightPosition - v_Position);
    vec3 v = normalize(u_EyePosition - v_Position);
    float d = distance(u_LightPosition, v_Position);
    float a = u_Attenuation[0] + d * (u_Attenuation[1] + d * u_Attenuation[2]);
    float c = dot(-l, normalize(u_SpotDirection));
    // the angles themselves, in degrees
    float angle = degrees(acos(clamp(c, -1.0, 1.0)));
    float spot = angle > u_SpotCutoff ? 0.0 : pow(max(c, 0.0), u_SpotExponent);
    float nl = max(dot(n, l), 0.0);
    float rv = max(dot(reflect(-l, n), v), 0.0);
    vec3 diffuse = v_Color.rgb * nl * u_LightColor;
    vec3 specular = vec3(0.0);
    if (nl > 0.0) specular = u_SpecularColor * pow(rv, u_Shininess) * u_LightColor;
    gl_FragColor = vec4(u_AmbientLight * v_Color.rgb + (diffuse + specular) * spot / a, 1.0);
}
