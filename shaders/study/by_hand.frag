precision highp float;
uniform vec3 u_Direction;
uniform vec3 u_Diffuse;
varying vec3 v_Normal;
void main() {
    float cosine = max(dot(normalize(v_Normal), u_Direction), 0.0);
    gl_FragColor = vec4(u_Diffuse * cosine, 1.0);
}
