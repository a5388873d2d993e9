// Übung 2: Streulicht und Umgebungslicht getrennt weitergeben
attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;
uniform mat4 u_MvpMatrix, u_NormalMatrix;
uniform vec3 u_LightColor[2], u_LightDirection[2];
varying vec3 v_Diffus;
varying vec3 v_Farbe;
void main() {
    vec3 n = vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0));
    n /= length(n);
    v_Diffus = vec3(0.0, 0.0, 0.0);
    for (int i = 1; i >= 0; i--) {
        float winkel = dot(n, u_LightDirection[i]);
        if (winkel > 0.0) v_Diffus = v_Diffus + winkel * u_LightColor[i];
    }
    v_Farbe = a_Color.rgb;
    gl_Position = u_MvpMatrix * a_Position;
}
