// side.glsl: whether a fragment is front-facing.

bool is_front() {
    return gl_FrontFacing;
}
