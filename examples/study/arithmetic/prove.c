/*
 * A bound for all points of each object: its triangles are cut into squares of the corners' shares,
 * each with the bound of its whole (proof.h); the one with the largest is cut into four again and
 * again, until it is not much above what is found at the middle of some piece, or as many were
 * bounded as time allows.
 */
#include "study/arithmetic/proof.h"

#include "base/memory.h"
#include "scene/quality.h"
#include "study/measure/scenes.h"

#include <math.h>
#include <stdlib.h>

typedef struct Piece {
    ProofTriangle triangle;
    double center[2], half;
    ProofBound bound;
} Piece;

/* The pieces of a draw; pieces[0] has the largest bound, and each at i those at 2 i + 1 and 2 i + 2
 * below it. */
typedef struct Pieces {
    const Proof *proof;
    Piece *pieces;
    int count, room, bounded;
} Pieces;

static void swap(Piece *a, Piece *b)
{
    const Piece c = *a;
    *a = *b;
    *b = c;
}

static void add(Pieces *to, const ProofTriangle *triangle, const double center[2], double half)
{
    if (center[0] + center[1] - 2 * half >= 1) /* beside the triangle */
        return;
    Piece made = {.triangle = *triangle, .center = {center[0], center[1]}, .half = half};
    made.bound = proof_piece(to->proof, triangle, center, half);
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
    const double half = piece->half / 2;
    for (int i = 0; i < 4; i++) {
        const double center[2] = {piece->center[0] + (i % 2 ? half : -half),
                                  piece->center[1] + (i / 2 ? half : -half)};
        add(pieces, &piece->triangle, center, half);
    }
}

/* At the middle of a piece, or of its part that is in the triangle. */
static double at_middle(const Proof *proof, const Piece *piece)
{
    const double beyond = fmax(piece->center[0] + piece->center[1] - 1, 0) / 2;
    const double at[2] = {piece->center[0] - beyond, piece->center[1] - beyond};
    return proof_piece(proof, &piece->triangle, at, 0).steps;
}

ProvedDraw prove_draw(const Proof *proof, int draw, int most)
{
    /* What is left to gain by more pieces is a twentieth, or not to be seen. */
    static const double NEAR = 1.05, SEEN = .01;
    Pieces pieces = {.proof = proof};
    ProvedDraw proved = {.draw = draw};
    for (ProofTriangle at = {.draw = draw, .number = -1}; proof_next(proof, &at) && at.draw == draw;
         proved.triangles++)
        add(&pieces, &at, (const double[2]){.5, .5}, .5);
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
    }
    proved.pieces = pieces.bounded;
    free(pieces.pieces);
    return proved;
}

static void tell_draw(const Proof *proof, const ProvedDraw *proved, int number, FILE *file)
{
    char text[64];
    const ProofBound *bound = &proved->bound;
    proof_text(proof, proved->draw, bound, text, sizeof text);
    if (bound->bounded)
        fprintf(file, "  object %d: at most %.3g steps before rounding", number, bound->steps);
    else
        fprintf(file, "  object %d: no bound exists; triangle %d, in", number, proved->triangle);
    if (bound->bounded && bound->steps > 0)
        fprintf(file, ", %.3g of them from", bound->share);
    if (!bound->bounded || bound->steps > 0)
        fprintf(file, " %s", text);
    fprintf(file, "; at single points up to %.3g (%d triangles in %d pieces)\n", proved->found,
            proved->triangles, proved->pieces);
}

static bool prove_scene(const Scene *scene, const Arithmetics *found, int height, FILE *file,
                        Message *message)
{
    enum { PIECES = 60000 }; /* some seconds */
    for (int i = 0; i < 2; i++) {
        const ProofDriver driver = {&found->of[METER_VERTEX][METER_HIGHP],
                                    &found->of[METER_FRAGMENT][i], &found->raster, height};
        Proof proof;
        if (!proof_open(&proof, scene, &driver, true, message))
            return false;
        fprintf(file, "%s:\n", METER_PRECISION_NAMES[i]);
        int draws = 0, number = 0;
        for (int k = 0; k < proof.capture.draw_count; k++)
            draws += proof_is_drawn(&proof, k);
        for (int k = 0; k < proof.capture.draw_count; k++) {
            if (!proof_is_drawn(&proof, k))
                continue;
            const ProvedDraw proved = prove_draw(&proof, k, PIECES / draws);
            tell_draw(&proof, &proved, ++number, file);
        }
        proof_close(&proof);
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
bool prove_study(int number, const CanvasBackend *backend, int height, FILE *file, Message *message)
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
            done = prove_scene(&made.scene, found, height, file, message);
            scene_copy_close(&made);
        }
        solid_meshes_close(&meshes);
        meter_close(&meter);
    }
    free(found);
    return done;
}
