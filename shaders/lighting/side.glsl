// side.glsl: whether a fragment belongs to the front.

bool is_front() {
    return gl_FrontFacing;
}
