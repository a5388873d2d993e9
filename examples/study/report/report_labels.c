#include "study/report/report_gnuplot.h"

#include <math.h>
#include <string.h>

/* Adds a word to the last line or a new one; false if all are full. */
static bool add_word(Label *label, const char *word)
{
    enum { WIDTH = 24 };
    char *line = label->lines[label->line_count - 1];
    size_t used = strlen(line);
    if (used && used + 2 + strlen(word) > WIDTH) {
        if (label->line_count == LABEL_LINES)
            return false;
        snprintf(line + used, LABEL_LINE_SIZE - used, ",");
        line = label->lines[label->line_count++];
        line[0] = '\0';
        used = 0;
    }
    snprintf(line + used, LABEL_LINE_SIZE - used, "%s%s", used ? ", " : "", word);
    return true;
}

void label_name(Label *label, const Quality *quality)
{
    int left_out = 0;
    label->line_count = 1;
    label->lines[0][0] = '\0';
    for (int axis = 0; axis < AXIS_COUNT; axis++) {
        const QualityAxisInfo *info = &QUALITY_AXES[axis];
        const char *choice = info->choices[quality->choice[axis]];
        char word[LABEL_LINE_SIZE - 12];
        if (quality->choice[axis] == info->usual)
            continue;
        if (axis == AXIS_INTERPOLATION || axis == AXIS_PRECISION)
            snprintf(word, sizeof word, "%s", choice);
        else
            snprintf(word, sizeof word, "%s %s", info->name, choice);
        left_out += left_out > 0 || !add_word(label, word);
    }
    char *last = label->lines[label->line_count - 1];
    const size_t used = strlen(last);
    if (left_out)
        snprintf(last + used, LABEL_LINE_SIZE - used, ", %d more", left_out);
    else if (!used)
        snprintf(last, LABEL_LINE_SIZE, "usual");
}

static double overlap(Place min, Place max, Place other_min, Place other_max)
{
    const double width = fmin(max.x, other_max.x) - fmax(min.x, other_min.x);
    const double height = fmin(max.y, other_max.y) - fmax(min.y, other_min.y);
    return width > 0 && height > 0 ? width * height : 0;
}

/* Whether the segment from a to b meets a box. */
static bool crosses(Place a, Place b, Place min, Place max)
{
    double from = 0, to = 1;
    const double starts[2] = {a.x, a.y}, ways[2] = {b.x - a.x, b.y - a.y};
    const double lows[2] = {min.x, min.y}, highs[2] = {max.x, max.y};
    for (int i = 0; i < 2; i++) {
        if (fabs(ways[i]) < 1e-9) {
            if (starts[i] < lows[i] || starts[i] > highs[i])
                return false;
            continue;
        }
        const double first = (lows[i] - starts[i]) / ways[i];
        const double second = (highs[i] - starts[i]) / ways[i];
        from = fmax(from, fmin(first, second));
        to = fmin(to, fmax(first, second));
    }
    return from <= to;
}

/* The point of a box nearest to a point. */
static Place nearest_in(Place point, Place min, Place max)
{
    return (Place){fmin(fmax(point.x, min.x), max.x), fmin(fmax(point.y, min.y), max.y)};
}

/* Whether a point other than a is nearly on the segment from a to b. */
static bool near_line(Place point, Place a, Place b)
{
    const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
    const double t = ((point.x - a.x) * x + (point.y - a.y) * y) / fmax(square, 1e-9);
    const double s = fmin(fmax(t, 0), 1);
    return hypot(point.x - a.x, point.y - a.y) > 1 &&
           hypot(point.x - a.x - s * x, point.y - a.y - s * y) < 9;
}

/* Whether a point is to the left of the line from a to b. */
static bool left_of(Place point, Place a, Place b)
{
    return (b.x - a.x) * (point.y - a.y) > (b.y - a.y) * (point.x - a.x);
}

static bool lines_cross(Place a, Place b, Place c, Place d)
{
    return left_of(c, a, b) != left_of(d, a, b) && left_of(a, c, d) != left_of(b, c, d);
}

/* The cost of a position, without that of its distance. */
static double cost(const Label *label, Place min, Place max, const Label *labels, int count,
                   const LabelGround *ground)
{
    static const double gap = 4, mark = 9;
    double sum = overlap(min, max, ground->taken_min, ground->taken_max) > 0 ? 1e4 : 0;
    const Place low = {min.x - gap, min.y - gap}, high = {max.x + gap, max.y + gap};
    const Place wide_low = {min.x - mark, min.y - mark};
    const Place wide_high = {max.x + mark, max.y + mark};
    const Place end = nearest_in(label->point, min, max);
    for (int i = 0; i < count; i++) {
        const Label *other = &labels[i];
        const bool before = other < label && other->placed;
        if (before && overlap(low, high, other->min, other->max) > 0)
            sum += 1e6;
        if (before && crosses(label->point, end, other->min, other->max))
            sum += 1e4;
        if (!before)
            continue;
        const Place other_end = nearest_in(other->point, other->min, other->max);
        if (crosses(other->point, other_end, low, high))
            sum += 1e4;
        if (lines_cross(label->point, end, other->point, other_end))
            sum += 1000;
    }
    for (int i = 0; i < ground->path_count; i++) {
        const Place at = ground->path[i];
        if (overlap(wide_low, wide_high, (Place){at.x - 1, at.y - 1}, (Place){at.x + 1, at.y + 1}) >
            0)
            sum += 5000;
        if (i + 1 < ground->path_count && crosses(at, ground->path[i + 1], low, high))
            sum += 1000;
        if (near_line(at, label->point, end))
            sum += 800;
    }
    for (int i = 0; i < ground->point_count; i++) {
        const Place at = ground->points[i];
        if (at.x > low.x && at.x < high.x && at.y > low.y && at.y < high.y)
            sum += 60;
    }
    return sum;
}

static void place(Label *label, const Label *labels, int count, const LabelGround *ground)
{
    static const double directions[][2] = {{-1, -1}, {-1, -0.4}, {-1, 0},  {-0.5, -1},
                                           {0, -1},  {1, 1},     {1, 0.4}, {0.5, 1},
                                           {0, 1},   {1, 0},     {-1, 1},  {1, -1}};
    static const double distances[] = {11, 18, 28, 42, 60, 80, 105, 135};
    double best = INFINITY, width = 0;
    const double height = ground->line * label->line_count;
    for (int i = 0; i < label->line_count; i++)
        width = fmax(width, ground->letter * (double)strlen(label->lines[i]));
    label->placed = false;
    for (size_t i = 0; i < sizeof distances / sizeof distances[0]; i++) {
        for (size_t j = 0; j < sizeof directions / sizeof directions[0]; j++) {
            const double x = directions[j][0], y = directions[j][1];
            const Place min = {label->point.x + x * distances[i] - (1 - x) / 2 * width,
                               label->point.y + y * distances[i] - (1 - y) / 2 * height};
            const Place max = {min.x + width, min.y + height};
            if (min.x < ground->min.x || min.y < ground->min.y || max.x > ground->max.x ||
                max.y > ground->max.y)
                continue;
            const double bad =
                cost(label, min, max, labels, count, ground) + 1.5 * distances[i] + (double)j;
            if (bad >= best)
                continue;
            best = bad;
            label->min = min;
            label->max = max;
            label->led = distances[i] > 18;
            label->placed = bad < 400; /* otherwise none is better */
        }
    }
}

void labels_place(Label *labels, int count, const LabelGround *ground)
{
    for (int i = 0; i < count; i++)
        place(&labels[i], labels, count, ground);
}
