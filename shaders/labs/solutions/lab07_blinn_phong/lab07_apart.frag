// Lab 7, written in another way: each term by itself.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // world space
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;  // Phong's
uniform vec3 u_EyePosition; // world space

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // world space

void main() {
    vec3 normal = normalize(v_Normal);
    vec3 viewDirection = normalize(u_EyePosition - v_Position);
    // N and H lie half as far apart as R and V: to fall off alike, the exponent must be four times
    // as large, and a little more for wide highlights.
    float shininess = 4.0 * u_Shininess + 1.3;
    vec3 color = u_AmbientLight * v_Color.rgb;
    for (int i = 0; i < 2; i++) {
        vec3 lightDirection = normalize(u_LightPosition[i] - v_Position);
        float nDotL = dot(normal, lightDirection);
        color += u_LightColor[i] * v_Color.rgb * max(nDotL, 0.0);
        vec3 halfway = normalize(lightDirection + viewDirection);
        float nDotH = max(dot(normal, halfway), 0.0);
        float highlight = nDotL > 0.0 ? pow(nDotH, shininess) : 0.0;
        color += u_LightColor[i] * u_SpecularColor * highlight;
    }
    gl_FragColor = vec4(color, v_Color.a);
}
