precision mediump float;
#define LIGHTS 2
uniform vec3 u_LightColor[LIGHTS];
uniform vec3 u_LightDirection[LIGHTS];
uniform vec3 u_AmbientLight;
varying vec3 fNormal;
varying vec4 fColor;

vec3 lambert(vec3 n, vec3 l, vec3 c) {
    return c * max(dot(n, l), 0.0);
}

void main() {
    vec3 n = normalize(fNormal);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LIGHTS; ++i)
        sum += lambert(n, u_LightDirection[i], u_LightColor[i]);
    gl_FragColor = fColor * vec4(sum + u_AmbientLight, 1.0);
}
