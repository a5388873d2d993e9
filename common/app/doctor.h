/*
 * doctor: what this machine can draw with, and what to install.
 */
#ifndef DOCTOR_H
#define DOCTOR_H

#include "core/canvas.h"

/* --doctor: prints the findings of every backend and module on standard output. Returns the exit
 * code: 0 if a backend works. */
int doctor_run(void);

/* Keeps, in the user's cache, a line about the numbers that a driver computes with: doctor_run
 * shows it beside a backend that finds this driver. */
void doctor_keep(const Canvas *canvas, const char *line);

#endif
