/*
 * module: a part of this project in a shared library of its own, loaded at the first need, because
 * what it links is large, slow to load, or may be missing.
 */
#ifndef MODULE_H
#define MODULE_H

#include "message.h"

typedef struct ModuleName {
    const char *file;    /* "image_oiio.so" */
    const char *entry;   /* the function in it that returns what it offers */
    const char *library; /* what it links, for messages: "OpenImageIO" */
    const char *package; /* to install where that is missing */
} ModuleName;

/* Loads a module and finds its entry: for a program in the build folder from there, for any other
 * from the installation beside it or from where this build was to be installed. NULL where it
 * cannot; the message names the package. */
void *module_entry(const ModuleName *name, Message *message);

/* The folder that the program is in; empty where that is not known. */
void module_program_folder(char folder[4096]);

#endif
