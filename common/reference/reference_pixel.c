/*
 * A pixel that its nine samples do not show to be smooth is divided into four squares. An edge that
 * cuts a square in two is located on the square's sides by bisection and assumed to be straight
 * between them, which is checked at its midpoint; the two parts count with their areas and the
 * colors at their centers. If that fails, the square is divided further, until it is too small to
 * matter. So an edge costs a few samples for each pixel that it crosses, at any precision, where a
 * grid of samples would cost the square of the precision.
 *
 * With E = edge_error / 255 and D the difference of the colors that meet (1 between objects,
 * because of coverage): an edge is at most sqrt(2) long in a pixel. Displaced by T it adds sqrt(2)
 * T D at most; T = E / 2 D leaves E / sqrt(2). A square of side h that is not resolved is its
 * samples' mean; an edge parallel to its sides crosses 1 / h such squares, each with an error of a
 * quarter of its area at most: D h / 4, so that squares with D h <= 4 E are not divided.
 */
#include "reference/reference_pixel.h"

#include <math.h>
#include <string.h>

/* A square of the picture; corners go round: upper left, upper right, lower right, lower left. */
typedef struct Square {
    double x, y, side;
    const Sample *corners[4], *center;
} Square;

static const double CORNERS[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

/* The side of a square whose samples differ although nothing tells them apart: then that is an
 * edge, too, however large an error is allowed. */
static const double SMALLEST = 1.0 / 128;

typedef struct Work {
    const PixelTracer *tracer;
    double error; /* E */
    int object;   /* at the pixel's center */
    double color[3], coverage;
    bool edge; /* one was found */
} Work;

static void sample_at(const Work *work, double x, double y, Sample *sample)
{
    uint64_t bits[2];
    memcpy(&bits[0], &x, sizeof x);
    memcpy(&bits[1], &y, sizeof y);
    /* Fibonacci hashing. (Knuth, The Art of Computer Programming, volume 3, section 6.4) */
    const uint64_t hash = (bits[0] * 0x9E3779B97F4A7C15U ^ bits[1]) * 0x9E3779B97F4A7C15U;
    PixelRecent *recent = &work->tracer->recent[(hash >> 32) % PIXEL_RECENT];
    if (!recent->taken || recent->x != x || recent->y != y) {
        *recent = (PixelRecent){.taken = true, .x = x, .y = y};
        trace_sample(work->tracer->trace, x, y, &recent->sample);
    }
    *sample = recent->sample;
}

static void add(Work *work, const Sample *sample, double area)
{
    for (int k = 0; k < 3; k++)
        work->color[k] += area * (double)sample->color[k];
    if (sample->object == work->object)
        work->coverage += area;
}

static double color_distance(const Sample *a, const Sample *b)
{
    double distance = 0;
    for (int k = 0; k < 3; k++)
        distance = fmax(distance, fabs((double)a->color[k] - (double)b->color[k]));
    return distance;
}

/* How far the color in the middle of samples is from their mean: about four times what it is from
 * the mean over the area between them. */
static double bend(const Sample *middle, const Sample *const *around, int count)
{
    double max = 0;
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < count; i++)
            sum += (double)around[i]->color[k];
        max = fmax(max, fabs((double)middle->color[k] - sum / count));
    }
    return max;
}

/* What a wrong share of the square would add to the pixel; `known` says whether there is an edge
 * for certain. */
static double contrast(const Work *work, const Square *square, bool *known)
{
    double max = 0;
    *known = work->edge;
    for (int i = 0; i < 4; i++) {
        const Sample *corner = square->corners[i];
        *known |= !trace_same_side(corner, square->center);
        max = corner->object != square->center->object
                  ? 1
                  : fmax(max, color_distance(corner, square->center));
    }
    return max;
}

/* The two parts of a square. */

typedef struct Point {
    double x, y;
} Point;

/* Samples that agree, and the polygon that they lie in. */
typedef struct Part {
    const Sample *members[8];
    int member_count;
    Point points[6];
    int point_count;
    double area;
    Point middle;
} Part;

static bool agrees(const Work *work, const Part *part, const Sample *sample)
{
    for (int i = 0; i < part->member_count; i++)
        if (trace_agree(work->tracer->trace, part->members[i], sample))
            return true;
    return false;
}

static Point corner_point(const Square *square, int i)
{
    return (Point){square->x + CORNERS[i][0] * square->side,
                   square->y + CORNERS[i][1] * square->side};
}

static Point between(Point a, Point b)
{
    return (Point){(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/* Moves two ends of a line, in different parts, to an edge between them, until they are `near` to
 * it. False where there is none after all, or more than one. */
static bool find_edge(const Work *work, Point *a, Sample *at_a, Point *b, Sample *at_b, double near)
{
    while (fabs(a->x - b->x) + fabs(a->y - b->y) > near) {
        const Point middle = between(*a, *b);
        Sample sample;
        sample_at(work, middle.x, middle.y, &sample);
        const bool is_a = trace_agree(work->tracer->trace, at_a, &sample);
        if (is_a == trace_agree(work->tracer->trace, at_b, &sample))
            return false;
        *(is_a ? a : b) = middle;
        *(is_a ? at_a : at_b) = sample;
    }
    return true;
}

/* Area and centroid. (Bourke, Calculating the area and centroid of a polygon, 1988) */
static void measure(Part *part)
{
    const Point origin = part->points[0];
    double twice = 0, x = 0, y = 0;
    for (int i = 1; i + 1 < part->point_count; i++) {
        const Point p = {part->points[i].x - origin.x, part->points[i].y - origin.y};
        const Point q = {part->points[i + 1].x - origin.x, part->points[i + 1].y - origin.y};
        const double cross = p.x * q.y - p.y * q.x;
        twice += cross;
        x += cross * (p.x + q.x) / 3;
        y += cross * (p.y + q.y) / 3;
    }
    part->area = fabs(twice) / 2;
    part->middle = twice != 0 ? (Point){origin.x + x / twice, origin.y + y / twice} : origin;
}

/* Which part each corner belongs to, 0 or 1; false where there are not two that one cut divides. */
static bool divide(const Work *work, const Square *square, Part parts[2], int part_of[4])
{
    int cuts = 0;
    parts[0] = (Part){.members = {square->corners[0]}, .member_count = 1};
    parts[1] = (Part){.member_count = 0};
    for (int i = 1; i < 5; i++) {
        const Sample *sample = i < 4 ? square->corners[i] : square->center;
        const bool first = agrees(work, &parts[0], sample);
        const bool second = agrees(work, &parts[1], sample);
        if (first && second)
            return false;
        if (!first && !second && parts[1].member_count > 0)
            return false;
        Part *part = &parts[!first];
        part->members[part->member_count++] = sample;
        if (i < 4)
            part_of[i] = !first;
    }
    part_of[0] = 0;
    for (int i = 0; i < 4; i++)
        cuts += part_of[i] != part_of[(i + 1) % 4];
    return cuts == 2;
}

/* Whether the edge between p and q is straight but for `width`: in their middle, so far to each
 * side, lie the two parts; and the center is where it should be. */
static bool straight(const Work *work, const Square *square, const Part parts[2], Point p, Point q,
                     double width)
{
    const Point middle = between(p, q);
    Point across = {q.y - p.y, p.x - q.x};
    const double length = hypot(across.x, across.y);
    const Point center = {square->x + square->side / 2, square->y + square->side / 2};
    if (!(length > 0))
        return true;
    across = (Point){across.x / length, across.y / length};
    /* Part 0 on the side of its corners. */
    const double side =
        (parts[0].middle.x - middle.x) * across.x + (parts[0].middle.y - middle.y) * across.y > 0
            ? 1
            : -1;
    const double out = side * ((center.x - middle.x) * across.x + (center.y - middle.y) * across.y);
    const bool center_first = agrees(work, &parts[0], square->center);
    if (fabs(out) > width && (out > 0) != center_first)
        return false;
    for (int i = 0; i < 2; i++) {
        const double way = (i == 0 ? side : -side) * width;
        const Point point = {middle.x + way * across.x, middle.y + way * across.y};
        Sample sample;
        if (point.x < square->x || point.x > square->x + square->side || point.y < square->y ||
            point.y > square->y + square->side)
            continue;
        sample_at(work, point.x, point.y, &sample);
        if (!agrees(work, &parts[i], &sample) || agrees(work, &parts[!i], &sample))
            return false;
    }
    return true;
}

/* Adds a square that one nearly straight edge parts in two; false where it is not such. */
static bool add_parted(Work *work, const Square *square, double difference)
{
    const double width =
        fmin(fmax(work->error / (2 * fmax(difference, 1e-3)), 0x1p-24), square->side / 8);
    Part parts[2];
    Point ends[2];
    Sample found[4], middles[2];
    int part_of[4], end_count = 0;
    if (!divide(work, square, parts, part_of))
        return false;
    for (int i = 0; i < 4; i++) {
        const int next = (i + 1) % 4, from = part_of[i], to = part_of[next];
        Point a = corner_point(square, i), b = corner_point(square, next);
        Part *here = &parts[from], *there = &parts[to];
        here->points[here->point_count++] = a;
        if (from == to)
            continue;
        Sample *at_a = &found[2 * end_count], *at_b = at_a + 1;
        *at_a = *square->corners[i];
        *at_b = *square->corners[next];
        if (!find_edge(work, &a, at_a, &b, at_b, width / 4))
            return false;
        here->members[here->member_count++] = at_a;
        there->members[there->member_count++] = at_b;
        ends[end_count] = between(a, b);
        here->points[here->point_count++] = ends[end_count];
        there->points[there->point_count++] = ends[end_count++];
    }
    measure(&parts[0]);
    measure(&parts[1]);
    if (!straight(work, square, parts, ends[0], ends[1], width))
        return false;
    for (int i = 0; i < 2; i++) {
        /* The middle of a sliver may lie in the other part; any of its samples will do. */
        const Part *part = &parts[i];
        middles[i] = *part->members[part->member_count - 1];
        if (part->area < width * square->side)
            continue;
        sample_at(work, part->middle.x, part->middle.y, &middles[i]);
        if (!agrees(work, part, &middles[i]) ||
            bend(&middles[i], part->members, part->member_count) * part->area >
                work->error * square->side)
            return false;
    }
    add(work, &middles[0], parts[0].area);
    add(work, &middles[1], parts[1].area);
    work->edge = true;
    return true;
}

/* Squares. */

static void add_unresolved(Work *work, const Square *square)
{
    const double area = square->side * square->side;
    add(work, square->center, area / 2);
    for (int i = 0; i < 4; i++)
        add(work, square->corners[i], area / 8);
    work->edge = true;
}

static bool smooth(const Work *work, const Square *square)
{
    for (int i = 0; i < 4; i++)
        if (!trace_agree(work->tracer->trace, square->center, square->corners[i]))
            return false;
    return true;
}

/* `middles` of its sides: above, right, below, left. */
static void add_quarters(Work *work, const Square *square, const Sample *const middles[4]);

static void add_square(Work *work, const Square *square)
{
    bool known;
    const double difference = contrast(work, square, &known);
    const bool small =
        known ? difference * square->side <= 4 * work->error : square->side <= SMALLEST;
    if (smooth(work, square)) {
        /* Where the color bends, as it does towards an object's outline, its middle is not its
         * mean. */
        if (square->side * square->side < work->error ||
            bend(square->center, square->corners, 4) <= 2 * work->error) {
            /* By Simpson's rule, as far as four corners have it: right for colors that bend like
             * parabolas. */
            const double area = square->side * square->side;
            add(work, square->center, area * 2 / 3);
            for (int i = 0; i < 4; i++)
                add(work, square->corners[i], area / 12);
            return;
        }
    } else if (small) {
        add_unresolved(work, square);
        return;
    } else if (add_parted(work, square, difference)) {
        return;
    }
    Sample samples[4];
    for (int i = 0; i < 4; i++) {
        const Point middle = between(corner_point(square, i), corner_point(square, (i + 1) % 4));
        sample_at(work, middle.x, middle.y, &samples[i]);
    }
    add_quarters(work, square,
                 (const Sample *const[4]){&samples[0], &samples[1], &samples[2], &samples[3]});
}

static void add_quarters(Work *work, const Square *square, const Sample *const middles[4])
{
    const double half = square->side / 2;
    for (int i = 0; i < 4; i++) {
        Sample center;
        Square quarter = {.x = square->x + CORNERS[i][0] * half,
                          .y = square->y + CORNERS[i][1] * half,
                          .side = half,
                          .center = &center};
        sample_at(work, quarter.x + half / 2, quarter.y + half / 2, &center);
        /* A quarter's corners: the square's in the same place, the square's center across from it,
         * and between them the middles of the sides. */
        quarter.corners[i] = square->corners[i];
        quarter.corners[(i + 1) % 4] = middles[i];
        quarter.corners[(i + 2) % 4] = square->center;
        quarter.corners[(i + 3) % 4] = middles[(i + 3) % 4];
        add_square(work, &quarter);
    }
}

Pixel pixel_resolve(const PixelTracer *tracer, int x, int y, const Sample *const rows[3])
{
    const Sample *top = rows[0], *middle = rows[1], *bottom = rows[2], *center = &middle[1];
    const Sample *const middles[4] = {&top[1], &middle[2], &bottom[1], &middle[0]};
    const Square square = {.x = x,
                           .y = y,
                           .side = 1,
                           .corners = {&top[0], &top[2], &bottom[2], &bottom[0]},
                           .center = center};
    Work work = {.tracer = tracer, .error = tracer->edge_error / 255, .object = center->object};
    bool agree = smooth(&work, &square);
    for (int i = 0; i < 4; i++)
        agree = agree && trace_agree(tracer->trace, center, middles[i]);
    if (!agree)
        add_quarters(&work, &square, middles);
    Pixel pixel = {.coverage = 1, .interior = !work.edge && center->object >= 0};
    for (int k = 0; k < 3; k++)
        pixel.color[k] = work.edge ? (float)work.color[k] : center->color[k];
    if (work.edge)
        pixel.coverage = (float)fmin(work.coverage, 1);
    return pixel;
}
