/*
 * lab_json: a lab from its folder, without a build.
 *
 * The folder has TASK.md, the starter's NAME.vert and NAME.frag, a folder "solution" with shaders
 * of the same names, or several that "solutions" lists, and lab.json (TEACHING.md describes it).
 */
#ifndef LAB_JSON_H
#define LAB_JSON_H

#include "labs/submission/submission.h"

#include <jansson.h>

typedef struct LabFolder {
    Lab lab;
    char path[PATH_MAX], name[LAB_NAME_SIZE], file[LAB_NAME_SIZE];
    LabUniform uniforms[LAB_MAX_UNIFORMS];
    SubmissionFiles solutions[LAB_MAX_SOLUTIONS];
    json_t *json; /* owns the texts */
} LabFolder;

/* Reads a folder from its JSON. False, with one line that names the file, the key and what to do.
 */
bool lab_json_read(LabFolder *folder, Message *message);

/* "2026-11-20 23:59", in local time, as seconds since 1970. False: it is none. */
bool lab_time_read(const char *text, long long *seconds);

/* lab_find's, or the lab of a folder that has lab.json; NULL, with a message: there is none. The
 * last folder's is kept, for the program's whole life. */
const Lab *lab_open(const char *text, Message *message);

#endif
