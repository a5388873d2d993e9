// shadow_back_faces.frag: shadow.frag, but a map has only the faces that are turned away from the
// light, so that the lit ones need no bias: as if every mesh were closed, and none mirrored.

#define main shadow_main
#include "../shadow.frag"
#undef main

void main() {
#ifdef DRAW_MAP
    if (gl_FrontFacing)
        discard;
#endif
    shadow_main();
}
