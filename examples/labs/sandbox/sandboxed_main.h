/*
 * sandboxed_main: the program in its sandbox: reads a submission, gives up its rights, judges.
 */
#ifndef SANDBOXED_MAIN_H
#define SANDBOXED_MAIN_H

/* PROGRAM --inside STEP USER SECONDS FOLDER ...: becomes that user (if root), takes on the limits,
 * then does one of these steps, with FOLDER for its files:
 *   prove HIDDEN PORT LABS   tries what must be impossible (breakout.h); its result is what failed
 *   check LAB SEED KIND PLACE NAME...   judges the submission in these places, of a SandboxSource;
 *     its results are the verdict as JSON and the picture
 * Standard output is as SandboxRun has it. Returns the exit code: 0 or SANDBOX_BROKEN. */
int sandboxed_main(int count, char *arguments[]);

#endif
