// output.glsl: the last step before the framebuffer, which clamps and rounds.

vec3 output_color(vec3 color) {
    return color;
}
