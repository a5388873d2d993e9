precision mediump float;
uniform vec3 u_AmbientLight;
varying vec3 v_Diffus;
varying vec3 v_Farbe;
void main() {
    vec3 licht = v_Diffus + u_AmbientLight; // Umgebungslicht nur einmal
    gl_FragColor.rgb = v_Farbe * licht;
    gl_FragColor.a = 1.0;
}
