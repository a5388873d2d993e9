precision highp float;
uniform vec3 u_LightColor, u_LightPosition, u_AmbientLight, u_SpecularColor, u_EyePosition;
uniform float u_Shininess;
varying vec3 v_Position;
varying vec4 v_Color;

void main() {
    vec3 N = normalize(v_Position), L = normalize(u_LightPosition - v_Position);
    float d = dot(N, L);
    vec3 c = u_AmbientLight * v_Color.rgb;
    if (d > 0.0) {
        vec3 V = normalize(u_EyePosition - v_Position);
        c += u_LightColor * (v_Color.rgb * d + u_SpecularColor * pow(max(dot(reflect(-L, N), V), 0.0), u_Shininess));
    }
    gl_FragColor = vec4(c, v_Color.a);
}
