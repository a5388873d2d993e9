// Lab 2: project each vertex; two directional lights, and ambient light once.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightDirection[2]; // world space, to the lights, normalized
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
    // What no light reaches has the ambient light alone; it comes once, not with each light.
    vec3 light = u_AmbientLight;
    for (int i = 0; i < 2; i++) {
        float nDotL = max(dot(u_LightDirection[i], normal), 0.0);
        light += u_LightColor[i] * nDotL;
    }
    v_Color = vec4(light * a_Color.rgb, a_Color.a);
}
