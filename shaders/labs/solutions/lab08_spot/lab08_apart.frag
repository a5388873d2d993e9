// Lab 8, written in another way: each term by itself.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_SpotDirection; // world space, from the light, normalized
uniform float u_SpotCutoff;   // half the cone's angle, in degrees
uniform float u_SpotExponent;
uniform vec3 u_Attenuation; // constant, linear, quadratic
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // world space

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // world space

void main() {
    vec3 normal = normalize(v_Normal);
    vec3 toLight = u_LightPosition - v_Position;
    float distance = length(toLight);
    vec3 lightDirection = toLight / distance;
    float nDotL = dot(normal, lightDirection);

    float cosine = dot(-lightDirection, u_SpotDirection);
    float spot = cosine >= cos(radians(u_SpotCutoff)) ? pow(max(cosine, 0.0), u_SpotExponent) : 0.0;
    float attenuation = 1.0 / (u_Attenuation.x + u_Attenuation.y * distance +
                               u_Attenuation.z * distance * distance);
    vec3 viewDirection = normalize(u_EyePosition - v_Position);
    vec3 reflected = reflect(-lightDirection, normal);
    float rDotV = max(dot(reflected, viewDirection), 0.0);
    float highlight = nDotL > 0.0 ? pow(rDotV, u_Shininess) : 0.0;
    vec3 color = u_AmbientLight * v_Color.rgb;
    color += attenuation * spot * u_LightColor * v_Color.rgb * max(nDotL, 0.0);
    color += attenuation * spot * u_LightColor * u_SpecularColor * highlight;
    gl_FragColor = vec4(color, v_Color.a);
}
