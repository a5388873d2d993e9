// Lab 10: light each fragment, with Phong's highlight, and nothing that the scene does not need.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition; // world space

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // world space

void main() {
    vec3 normal = normalize(v_Normal);
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    float nDotL = dot(normal, lightDirection);
    vec3 color = u_AmbientLight * v_Color.rgb;
    if (nDotL > 0.0) {
        vec3 viewDirection = normalize(u_EyePosition - v_Position);
        float rDotV = max(dot(2.0 * nDotL * normal - lightDirection, viewDirection), 0.0);
        color += u_LightColor * (v_Color.rgb * nDotL + u_SpecularColor * pow(rDotV, u_Shininess));
    }
    gl_FragColor = vec4(color, v_Color.a);
}
