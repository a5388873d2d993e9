// map: lab 11's shadow map: depths from 0 to 1, packed into red, green and blue.

precision highp float;

varying vec2 v_Depth;

void main() {
    vec3 parts = fract((0.5 * v_Depth.x / v_Depth.y + 0.5) * vec3(1.0, 255.0, 65025.0));
    parts.xy -= parts.yz / 255.0;
    gl_FragColor = vec4(parts, 1.0);
}
