// Lab 4: project each vertex; two point lights.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2]; // world space
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    vec3 position = vec3(u_ModelMatrix * a_Position);
    vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
    vec3 light = u_AmbientLight;
    for (int i = 0; i < 2; i++) {
        // From this very vertex to the light: another direction at each.
        vec3 lightDirection = normalize(u_LightPosition[i] - position);
        float nDotL = max(dot(lightDirection, normal), 0.0);
        light += u_LightColor[i] * nDotL;
    }
    v_Color = vec4(light * a_Color.rgb, a_Color.a);
}
