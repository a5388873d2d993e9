precision highp float;
uniform vec3 u_LightColor, u_AmbientLight, u_SpecularColor;
uniform float u_Shininess;
varying vec3 toEye, toLight, normal;
varying vec4 color;
void main() {
    vec3 n = normalize(normal), l = normalize(toLight), v = normalize(toEye);
    float diffuse = max(dot(n, l), 0.0);
    float rv = 2.0 * dot(n, l) * dot(n, v) - dot(l, v);
    float specular = diffuse > 0.0 && rv > 0.0 ? pow(rv, u_Shininess) : 0.0;
    gl_FragColor = vec4(color.rgb * (u_AmbientLight + diffuse * u_LightColor) + specular * u_SpecularColor * u_LightColor, 1.0);
}
