/*
 * proof_state: what the files of proof share, for them alone.
 */
#ifndef PROOF_STATE_H
#define PROOF_STATE_H

#include "core/orbit.h"
#include "glsl/glsl_bound_tape.h"
#include "probe/stages.h"
#include "study/arithmetic/proof.h"

/* A number of a vertex, as in GlslInput; its slopes are by the camera's directions. */
typedef struct Output {
    double value, error, slack;
    GlslRange slope[GLSL_WAYS];
} Output;

/* A uniform's number that depends on the camera. */
typedef struct ProofFit {
    int stage, at; /* its register */
    bool known; /* as this sum, up to `slack`: of the products of {1, cos, sin} of the azimuth and
                   of the elevation, and of the distance less 1 */
    double parts[9], far, slack;
} ProofFit;

typedef struct ProofDraw {
    Stages stages;
    GlslBoundRun *runs[2];
    GlslErrors errors[2];
    Output *vertices;     /* by number: the clip coordinates, then what each hands over */
    int *moments, moment; /* those are of the box if they are of its moment */
    ProofBox box;
    const Output *corners[3];
    ProofFit *fits;
    int fit_count, fit_room;
} ProofDraw;

/* What a vertex hands over from the cameras that are set, after its place (proof_vertex). */
const Output *proof_output(const Proof *proof, int draw, unsigned vertex);

/* Draws the scene into the capture; with cameras, those of the range after the planned one. */
bool proof_capture(Proof *proof, const Scene *scene, bool shadows, Message *message);

/* What of a draw's uniforms depends on the camera; what they are from the cameras of a box. */
void proof_find_fits(const Proof *proof, int draw);
void proof_set_fits(const Proof *proof, int draw, const ProofBox *box);

/* By how much a float can be from a number of this magnitude. */
double proof_float_error(double magnitude);

#endif
