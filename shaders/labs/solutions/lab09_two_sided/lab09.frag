// Lab 9: light both sides, each with its own colour and its own normal.

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
    // A mirror turns the order of a triangle's corners around, and gl_FrontFacing with it.
    bool front = gl_FrontFacing == (u_Mirrored > 0.0);
    vec3 normal = normalize(v_Normal);
    vec4 color = v_Color;
    if (!front) {
        normal = -normal;
        color = u_BackColor;
    }
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    float nDotL = max(dot(normal, lightDirection), 0.0);
    vec3 light = u_AmbientLight + u_LightColor * nDotL;
    gl_FragColor = vec4(light * color.rgb, color.a);
}
