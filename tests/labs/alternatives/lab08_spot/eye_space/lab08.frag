precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_SpotDirection, u_Attenuation;
uniform float u_SpotCutoff, u_SpotExponent, u_Shininess;
uniform vec3 u_AmbientLight, u_SpecularColor;

uniform mat4 u_ViewMatrix;
varying vec3 v_EyePosition, v_EyeNormal;
varying vec4 v_Color;

float attenuation(float d) { return 1.0 / dot(u_Attenuation, vec3(1.0, d, d * d)); }

float cone(float cosine) {
    if (cosine < cos(radians(u_SpotCutoff)))
        return 0.0;
    return pow(cosine, u_SpotExponent);
}

void main() {
    vec3 lightEye = vec3(u_ViewMatrix * vec4(u_LightPosition, 1.0));
    vec3 axisEye = vec3(u_ViewMatrix * vec4(u_SpotDirection, 0.0));
    vec3 ray = v_EyePosition - lightEye; // as the light travels
    float d = length(ray);
    ray /= d;
    vec3 n = normalize(v_EyeNormal);
    vec3 result = v_Color.rgb * u_AmbientLight;
    float strength = cone(dot(ray, axisEye)) * attenuation(d);
    float nl = -dot(ray, n);
    if (nl > 0.0) {
        float rv = max(dot(reflect(ray, n), normalize(-v_EyePosition)), 0.0);
        result += strength * u_LightColor * (nl * v_Color.rgb + pow(rv, u_Shininess) * u_SpecularColor);
    }
    gl_FragColor = vec4(result, v_Color.a);
}
