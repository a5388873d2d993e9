attribute vec4 a_Position;
attribute vec3 a_Normal;
attribute vec3 a_Color;
uniform mat4 u_MvpMatrix, u_NormalMatrix;
varying vec3 n;
varying vec3 kd;

void main()
{
    n = mat3(u_NormalMatrix) * a_Normal;
    kd = a_Color;
    gl_Position = u_MvpMatrix * a_Position;
}
