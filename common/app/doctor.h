/*
 * doctor: what this machine can draw with, and what to install.
 */
#ifndef DOCTOR_H
#define DOCTOR_H

/* --doctor: prints the findings of every backend and module on standard output. Returns the exit
 * code: 0 if a backend works. */
int doctor_run(void);

#endif
