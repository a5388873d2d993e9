precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_AmbientLight, u_SpecularColor, u_EyePosition;
uniform float u_Shininess;
varying vec3 v_Position;
varying vec4 v_Color;

void main() {
    // Where the ray from the eye meets the exact sphere.
    vec3 V = normalize(u_EyePosition - v_Position);
    float b = dot(u_EyePosition, V), c = dot(u_EyePosition, u_EyePosition) - 1.0;
    float t = b - sqrt(max(b * b - c, 0.0));
    vec3 N = normalize(u_EyePosition - t * V);
    vec3 L = normalize(u_LightPosition - N);
    float d = dot(N, L);
    vec3 color = u_AmbientLight * v_Color.rgb;
    if (d > 0.0) {
        vec3 R = 2.0 * d * N - L;
        color += u_LightColor * (v_Color.rgb * d + u_SpecularColor * pow(max(dot(R, V), 0.0), u_Shininess));
    }
    gl_FragColor = vec4(color, 1.0);
}
