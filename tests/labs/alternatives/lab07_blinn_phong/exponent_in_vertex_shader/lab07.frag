precision highp float;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform vec3 u_EyePosition;
varying vec4 v_Color;
varying vec3 v_Normal, v_Position;
varying float v_Exponent;
void main() {
    vec3 N = normalize(v_Normal);
    vec3 V = normalize(u_EyePosition - v_Position);
    vec3 diffuse = u_AmbientLight, specular = vec3(0.0);
    for (int i = 0; i < 2; i++) {
        vec3 L = normalize(u_LightPosition[i] - v_Position);
        float d = dot(N, L);
        if (d > 0.0) {
            diffuse += d * u_LightColor[i];
            specular += pow(max(dot(N, normalize(L + V)), 0.0), v_Exponent) * u_LightColor[i];
        }
    }
    gl_FragColor = vec4(diffuse * v_Color.rgb + specular * u_SpecularColor, 1.0);
}
