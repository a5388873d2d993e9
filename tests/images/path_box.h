/*
 * path_box: where the ink of a drawing's path lies, or more: control points and the pen's width
 * count.
 */
#ifndef PATH_BOX_H
#define PATH_BOX_H

#include "images/drawing.h"

#include <math.h>

static inline DrawingBox path_box(const Drawing *drawing, const DrawingPath *path)
{
    static const int POINTS[] = {
        [DRAWING_MOVE] = 1, [DRAWING_LINE] = 1, [DRAWING_CURVE] = 3, [DRAWING_CLOSE] = 0};
    const double pen = path->style.width / 2;
    DrawingBox box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    int count = 0;
    for (int i = 0; i < path->step_count; i++)
        count += POINTS[drawing->steps[path->first_step + i]];
    for (int i = 0; i < count; i++) {
        const DrawingPoint p = drawing->points[path->first_point + i];
        box.left = fmin(box.left, p.x - pen);
        box.right = fmax(box.right, p.x + pen);
        box.top = fmin(box.top, p.y - pen);
        box.bottom = fmax(box.bottom, p.y + pen);
    }
    return box;
}

#endif
