// Lab 9, written in another way: each term by itself.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_AmbientLight;
uniform vec4 u_BackColor;
uniform float u_Mirrored; // -1 if the model matrix mirrors, else 1

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // world space

void main() {
    bool front = gl_FrontFacing == (u_Mirrored > 0.0);
    vec3 normal = normalize(v_Normal);
    vec4 color = v_Color;
    if (!front) {
        normal = -normal;
        color = u_BackColor;
    }
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    float nDotL = max(dot(normal, lightDirection), 0.0);
    gl_FragColor = vec4(u_AmbientLight * color.rgb + u_LightColor * color.rgb * nDotL, color.a);
}
