precision mediump float;
varying vec3 v_Light;
varying vec4 v_Base;
void main()
{
    gl_FragColor = vec4(v_Light, 1.0) * v_Base;
}
