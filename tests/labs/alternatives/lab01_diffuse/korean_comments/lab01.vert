// 실습 1: 꼭짓점마다 확산광을 계산한다 (Gouraud)
#define LIGHT u_LightDirection
attribute vec4 a_Position;   // 위치
attribute vec4 a_Normal;     // 법선 벡터
attribute vec4 a_Color;      // 색
uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix; // 역행렬의 전치
uniform vec3 u_LightColor;
uniform vec3 LIGHT;
varying vec4 v_Color;

float cosine(const in vec3 a, const in vec3 b) { return max(0.0, dot(a, b)); } // 음수는 0으로

void main(void) {
    vec3 n = normalize((u_NormalMatrix * vec4(a_Normal.xyz, 0.)).xyz);
    float c = cosine(LIGHT, n);
    v_Color = vec4(c, c, c, 1.) * vec4(u_LightColor, 1.) * a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
