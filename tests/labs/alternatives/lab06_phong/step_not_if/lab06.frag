#version 100
#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif
#define NUM_LIGHTS 2
uniform vec3 u_LightColor[NUM_LIGHTS];
uniform vec3 u_LightPosition[NUM_LIGHTS];
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
uniform vec3 u_EyePosition;
varying vec3 v_Position;
varying vec3 v_Normal;
varying vec4 v_Color;
void main() {
    vec3 normal = normalize(v_Normal);
    vec3 eye = normalize(u_EyePosition - v_Position);
    vec4 result = vec4(u_AmbientLight, 1.0) * v_Color;
    for (int i = 0; i < NUM_LIGHTS; ++i) {
        vec3 light = normalize(u_LightPosition[i] - v_Position);
        float lambert = max(0.0, dot(normal, light));
        float spec = max(0.0, dot(reflect(-light, normal), eye));
        float isLit = 1.0 - step(lambert, 0.0);
        result.rgb += u_LightColor[i] * v_Color.rgb * lambert;
        result.rgb += u_LightColor[i] * u_SpecularColor * isLit * pow(spec, u_Shininess);
    }
    gl_FragColor = result;
}
