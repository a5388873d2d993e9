// Fog: light each fragment, then mix it with the fog.

precision highp float;

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_AmbientLight;
uniform vec3 u_EyePosition; // world space
uniform vec3 u_FogColor;
uniform float u_FogDensity;

varying vec4 v_Color;
varying vec3 v_Normal;   // world space
varying vec3 v_Position; // world space

void main() {
    vec3 normal = normalize(v_Normal);
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    float nDotL = max(dot(normal, lightDirection), 0.0);
    vec3 lit = (u_AmbientLight + u_LightColor * nDotL) * v_Color.rgb;
    // To do: how much of it is seen through the fog.
    gl_FragColor = vec4(lit, v_Color.a);
}
