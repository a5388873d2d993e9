/*
 * A bound for all points of each object: its triangles are cut into squares of the corners' shares,
 * each with the bound of its whole (proof.h), from all cameras of a range, which is cut, too; the
 * one with the largest is cut again and again, in the direction in which most changes, until it is
 * not much above what is found at the middle of some piece, or as many were bounded as time allows.
 */
#include "study/arithmetic/proof.h"

#include "base/memory.h"
#include "scene/quality.h"
#include "study/measure/scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double RADIANS = 0.017453292519943295;

typedef struct Piece {
    ProofTriangle triangle;
    ProofBox box;
    ProofBound bound;
} Piece;

/* The pieces of a draw; pieces[0] has the largest bound, and each at i those at 2 i + 1 and 2 i + 2
 * below it. */
typedef struct Pieces {
    const Proof *proof;
    Piece *pieces;
    int count, room, bounded, triangles;
} Pieces;

static void swap(Piece *a, Piece *b)
{
    const Piece c = *a;
    *a = *b;
    *b = c;
}

static void add(Pieces *to, const ProofTriangle *triangle, const ProofBox *box)
{
    if (box->center[0] + box->center[1] - 2 * box->half[0] >= 1) /* beside the triangle */
        return;
    Piece made = {.triangle = *triangle, .box = *box};
    made.bound = proof_piece(to->proof, triangle, box);
    to->bounded++;
    *(Piece *)memory_add(&to->pieces, &to->count, &to->room, sizeof made) = made;
    for (int i = to->count - 1; i > 0; i = (i - 1) / 2) {
        Piece *at = &to->pieces[i], *above = &to->pieces[(i - 1) / 2];
        if (!(at->bound.steps > above->bound.steps))
            break;
        swap(at, above);
    }
}

static Piece take(Pieces *from)
{
    const Piece taken = from->pieces[0];
    from->pieces[0] = from->pieces[--from->count];
    for (int i = 0, next = 1; next < from->count; i = next, next = 2 * i + 1) {
        if (next + 1 < from->count &&
            from->pieces[next + 1].bound.steps > from->pieces[next].bound.steps)
            next++;
        if (!(from->pieces[next].bound.steps > from->pieces[i].bound.steps))
            break;
        swap(&from->pieces[i], &from->pieces[next]);
    }
    return taken;
}

static void cut(Pieces *pieces, const Piece *piece)
{
    const int way = piece->bound.widest;
    for (int i = 0; i < (way < 2 ? 4 : 2); i++) {
        ProofBox box = piece->box;
        for (int k = way < 2 ? 0 : way; k <= (way < 2 ? 1 : way); k++) {
            box.half[k] /= 2;
            box.center[k] += (way < 2 && k ? i / 2 : i % 2) ? box.half[k] : -box.half[k];
        }
        add(pieces, &piece->triangle, &box);
    }
}

/* At the middle of a piece, or of its part that is in the triangle. */
static double at_middle(const Proof *proof, const Piece *piece)
{
    ProofBox at = {.half = {0}};
    memcpy(at.center, piece->box.center, sizeof at.center);
    const double beyond = fmax(at.center[0] + at.center[1] - 1, 0) / 2;
    at.center[0] -= beyond;
    at.center[1] -= beyond;
    return proof_piece(proof, &piece->triangle, &at).steps;
}

/* Whole triangles, from cameras that are not too far from each other for the most to have a bound;
 * of fewer and larger ranges, if that were too many. */
static void add_all(Pieces *pieces, int draw, int most)
{
    static const double NEAR[3] = {.18, .18, .25};
    const Proof *proof = pieces->proof;
    const double all = most / fmax(proof->capture.draws[draw].vertex_count / 3., 1);
    ProofBox box = {{.5, .5, 0, 0, 1}, {.5, .5}};
    double low[3], width[3], parts = 1;
    int count[3];
    for (int k = 0; k < 3; k++) {
        const double unit = k < 2 ? RADIANS : 1;
        low[k] = proof->moves ? unit * proof->cameras.low[k] : box.center[2 + k];
        width[k] = proof->moves ? unit * proof->cameras.high[k] - low[k] : 0;
        parts *= ceil(fmax(width[k] / NEAR[k], 1));
    }
    const double fewer = fmin(cbrt(all / parts), 1);
    for (int k = 0; k < 3; k++)
        count[k] = (int)fmax(ceil(width[k] / NEAR[k]) * fewer, 1);
    for (int i = 0; i < count[0] * count[1] * count[2]; i++) {
        const int at[3] = {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
        for (int k = 0; k < 3; k++) {
            box.half[2 + k] = width[k] / count[k] / 2;
            box.center[2 + k] = low[k] + (2 * at[k] + 1) * box.half[2 + k];
        }
        pieces->triangles = 0;
        for (ProofTriangle next = {.draw = draw, .number = -1};
             proof_next(proof, &next) && next.draw == draw; pieces->triangles++)
            add(pieces, &next, &box);
    }
}

/* From the bounds of at most so many pieces more than there are triangles. */
static ProvedDraw prove_draw(const Proof *proof, int draw, int most)
{
    /* What is left to gain by more pieces is a twentieth, or not to be seen. */
    static const double NEAR = 1.05, SEEN = 1e-4;
    Pieces pieces = {.proof = proof};
    ProvedDraw proved = {.draw = draw};
    add_all(&pieces, draw, most);
    proved.triangles = pieces.triangles;
    while (pieces.count && pieces.bounded < most + proved.triangles) {
        const double found = at_middle(proof, &pieces.pieces[0]);
        proved.found = fmax(proved.found, found);
        if (pieces.pieces[0].bound.steps <= NEAR * proved.found + SEEN)
            break;
        const Piece piece = take(&pieces);
        cut(&pieces, &piece);
    }
    if (pieces.count) {
        proved.bound = pieces.pieces[0].bound;
        proved.triangle = pieces.pieces[0].triangle.number;
        for (int k = 0; k < 3; k++)
            proved.camera[k] = pieces.pieces[0].box.center[2 + k] / (k < 2 ? RADIANS : 1);
    }
    proved.pieces = pieces.bounded;
    free(pieces.pieces);
    return proved;
}

static void tell_draw(const ProvedDraw *proved, int number, bool moves, FILE *file)
{
    const ProofBound *bound = &proved->bound;
    if (bound->bounded)
        fprintf(file, "  object %d: at most %.3g steps before rounding", number, bound->steps);
    else
        fprintf(file, "  object %d: no bound exists; triangle %d, in", number, proved->triangle);
    if (bound->bounded && bound->steps > 0)
        fprintf(file, ", %.3g of them from", bound->share);
    if (!bound->bounded || bound->steps > 0)
        fprintf(file, " %s", proved->text);
    if (moves && (!bound->bounded || bound->steps > 0))
        fprintf(file, ", near --orbit %.3g,%.3g,%.3g", proved->camera[0], proved->camera[1],
                proved->camera[2]);
    fprintf(file, "; at single points up to %.3g (%d triangles in %d pieces)\n", proved->found,
            proved->triangles, proved->pieces);
}

bool prove_scene(const Scene *scene, const ProofDriver *driver, const ProofCameras *cameras,
                 int pieces, Proved *proved, Message *message)
{
    const int most = (int)(sizeof proved->draws / sizeof *proved->draws);
    Proof proof;
    int draws = 0;
    proved->count = 0;
    if (!proof_open(&proof, scene, driver, true, cameras, message))
        return false;
    for (int k = 0; k < proof.draw_count; k++)
        draws += proof_is_drawn(&proof, k);
    for (int k = 0; k < proof.draw_count && proved->count < most; k++)
        if (proof_is_drawn(&proof, k)) {
            ProvedDraw *made = &proved->draws[proved->count++];
            *made = prove_draw(&proof, k, pieces / draws);
            proof_text(&proof, k, &made->bound, made->text, sizeof made->text);
        }
    proof_close(&proof);
    return true;
}

static bool read_cameras(const Parameter *parameter, const char *text, Message *message)
{
    static const double min[] = {-3600, -90, 0.01}, max[] = {3600, 90, 100};
    ProofCameras range = {{0, 0, 1}, {0, 0, 1}};
    double *low = range.low, *high = range.high;
    int length = 0;
    sscanf(text, "%lf:%lf,%lf:%lf%n,%lf:%lf%n", low, high, low + 1, high + 1, &length, low + 2,
           high + 2, &length);
    bool read = length > 0 && text[length] == '\0';
    for (int k = 0; k < 3; k++)
        read = read && low[k] >= min[k] && low[k] <= high[k] && high[k] <= max[k];
    *(ProofCameras *)parameter->value = range;
    return read || message_set(message,
                               "--cameras %s: must be ranges of azimuth, elevation and, perhaps, "
                               "distance as --orbit has them, as in -5:5,0:5,1:1.1",
                               text);
}

const ParameterCodec PROOF_CAMERAS = {"AZ:AZ,EL:EL[,DIST:DIST]", read_cameras, NULL};

static bool tell_scene(const Scene *scene, const ProofCameras *cameras, const Arithmetics *found,
                       int height, FILE *file, Message *message)
{
    enum { PIECES = 60000 }; /* some seconds */
    for (int i = 0; i < 2; i++) {
        const ProofDriver driver = {&found->of[METER_VERTEX][METER_HIGHP],
                                    &found->of[METER_FRAGMENT][i], &found->raster, height};
        Proved proved;
        if (!prove_scene(scene, &driver, cameras, PIECES, &proved, message))
            return false;
        fprintf(file, "%s:\n", METER_PRECISION_NAMES[i]);
        for (int k = 0; k < proved.count; k++)
            tell_draw(&proved.draws[k], k + 1, cameras != NULL, file);
    }
    fprintf(file,
            "Steps of 1/255, for all points; a byte's rounding adds %.2f. Left out are pixels "
            "through which\nan edge of light or of a shadow runs, or whose middle is beside a side "
            "of a triangle, within\n2^-%d of a pixel. Assumed: the errors that were measured of "
            "%s,\nand that its compiler keeps the text's operations or rounds less.\n",
            found->raster.bytes, found->raster.subpixel_bits, found->renderer);
    return true;
}

/* With no settings but the usual. */
bool prove_study(int number, const ProofCameras *cameras, const CanvasBackend *backend, int height,
                 FILE *file, Message *message)
{
    Arithmetics *found = memory_new(1, sizeof *found);
    const Quality quality = quality_usual();
    SolidMeshes meshes = {.first = NULL};
    StudyScene study;
    SceneCopy made;
    Meter meter;
    bool done = meter_open(&meter, backend, message);
    if (done) {
        study_scene(number, &study);
        done = arithmetic_measure(&meter, 1 << 17, found, message) &&
               quality_scene_open(&made, &study.scene, &quality, &meshes, message);
        if (done) {
            fprintf(file, "%s, %d rows\n", STUDY_SCENES[number].name, height);
            done = tell_scene(&made.scene, cameras, found, height, file, message);
            scene_copy_close(&made);
        }
        solid_meshes_close(&meshes);
        meter_close(&meter);
    }
    free(found);
    return done;
}
