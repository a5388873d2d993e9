// Lab 5: light each fragment.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // world space
uniform vec3 u_AmbientLight;

varying vec4 v_Color;
varying vec3 v_Normal;
varying vec3 v_Position; // world space

void main() {
    // Between vertices the interpolated normal may be shorter than 1.
    vec3 normal = normalize(v_Normal);
    vec3 light = u_AmbientLight;
    for (int i = 0; i < 2; i++) {
        vec3 lightDirection = normalize(u_LightPosition[i] - v_Position);
        float nDotL = max(dot(lightDirection, normal), 0.0);
        light += u_LightColor[i] * nDotL;
    }
    gl_FragColor = vec4(light * v_Color.rgb, v_Color.a);
}
