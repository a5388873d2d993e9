/*
 * page: all programs in one module, as a page of the browser calls it (module.js). One program is
 * open at a time. Plain C: natively, tests compare what it draws with what a page shows.
 */
#ifndef PAGE_H
#define PAGE_H

/* Texts that are returned are valid until the next call. */

/* The programs and their options as JSON: what a page needs to make its controls, and the names of
 * the options that a program has natively only. */
const char *page_programs(void);

/* Opens a program: its name and then arguments "--NAME" or "--NAME=VALUE", a line each. One that
 * only other options were given for keeps its compiled shaders. 0, or 1 or 2 as a program would
 * exit, and page_message; then none is open. */
int page_open(const char *lines);

/* Why the last call failed; else a warning about shaders, or "". */
const char *page_message(void);

/* Draws the picture at that time, with the camera there. 0 on failure. */
int page_draw(double seconds, double azimuth, double elevation, double distance, double roll);

/* Of the last picture: RGBA, row 0 at the top. */
const unsigned char *page_pixels(void);
int page_width(void);
int page_height(void);

/* The values of the open program's options as they are, {"size": "400x400", ...}: some follow from
 * others. */
const char *page_values(void);

/* The command that draws the last picture natively. */
const char *page_command(void);

/* Writes on standard output what --explain does, with --verbose if `receipts`. 0 on failure. */
int page_explain(int receipts);

/* The shader files of the open program, [{"name": ..., "text": ...}]. */
const char *page_shaders(void);

/* Puts a text of so many bytes in place of a shader file for the next page_open; an empty name: no
 * file is replaced any more. 0 on failure, which changes nothing. */
int page_replace(const char *name, const char *text, int size);

/* Computes the exact picture of the last one: a second or more. Returns the errors as JSON, "" on
 * failure; page_pixels are then the map of errors, or with `exact` that picture. */
const char *page_error(int exact);

/* Closes the program and its canvas, also when WebGL has lost it. */
void page_close(void);

#endif
