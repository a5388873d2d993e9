// Spot: light each fragment with a spot light whose edge is as soft as its two cones are apart.

precision highp float;

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_SpotDirection; // world space, from the light, normalized
uniform float u_CosOuterCut;
uniform float u_CosInnerCut;
uniform vec3 u_Attenuation; // constant, linear, quadratic
uniform vec3 u_AmbientLight;

varying vec4 v_Color;
varying vec3 v_Normal;   // world space
varying vec3 v_Position; // world space

void main() {
    vec3 toLight = u_LightPosition - v_Position;
    float d = length(toLight);
    vec3 lightDirection = toLight / d;
    float nDotL = max(dot(normalize(v_Normal), lightDirection), 0.0);

    float cosine = dot(-lightDirection, u_SpotDirection);
    float spot = smoothstep(u_CosOuterCut, u_CosInnerCut, cosine);
    float attenuation = 1.0 / (u_Attenuation.x + u_Attenuation.y * d + u_Attenuation.z * d * d);
    vec3 light = u_AmbientLight + u_LightColor * (nDotL * spot * attenuation);
    gl_FragColor = vec4(light * v_Color.rgb, v_Color.a);
}
