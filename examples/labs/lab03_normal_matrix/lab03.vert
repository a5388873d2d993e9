// Lab 3, given: project and light each vertex, with the normal from the normal matrix.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor;
uniform vec3 u_LightDirection; // world space, to the light, normalized
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
    float nDotL = max(dot(u_LightDirection, normal), 0.0);
    vec3 light = u_AmbientLight + u_LightColor * nDotL;
    v_Color = vec4(light * a_Color.rgb, a_Color.a);
}
