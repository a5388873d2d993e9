// dithered.glsl: lighting/output.glsl with half a step of noise, so that rounding to 8 bits is right
// on average. (The noise: Jimenez, Next generation post processing in Call of Duty: Advanced
// Warfare, SIGGRAPH 2014 courses)

vec3 output_color(vec3 color) {
    float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    return color + (noise - 0.5) / 255.0;
}
