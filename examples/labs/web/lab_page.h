/*
 * lab_page: the labs as one module, as a page of the browser calls it: their pictures and `check`.
 * One lab is open at a time. What `check` does in processes of its own is in files beside this one.
 */
#ifndef LAB_PAGE_H
#define LAB_PAGE_H

/* Texts that are returned are valid until the next call. */

/* Opens a lab by its name, or by the folder that page_own wrote, with the starter's files. 0, or 2
 * and page_message. */
int page_open(const char *name);

/* Writes a file of a lab's folder, "/own/spot/lab.json". 0 on failure. */
int page_own(const char *path, const char *text);

/* Why the last call failed, or "". */
const char *page_message(void);

/* Puts a text of so many bytes in place of one of the lab's files; an empty name: the starter's in
 * place of all. 0 on failure. */
int page_replace(const char *name, const char *text, int size);

/* Draws the lab's own scene at that time as its program does. 0 on failure. */
int page_draw(double seconds);

/* The exact picture of the same scene, in page_pixels. 0 on failure. */
int page_expected(double seconds);

/* The difference of the two last ones of one time, brightened, in page_pixels; the largest error
 * inside objects in steps of 1/255, or -1 on failure. */
double page_difference(void);

/* What `check LAB FOLDER --seed SEED` says, as its --json; "text" is what it prints. page_pixels
 * are then the worst scene (width 0: none is wrong). "" on failure. */
const char *page_check(double seed);

/* After page_open: draws the picture of that time, and keeps its draws, for the next three.
 * `device`: as --arithmetic names it. 0 on failure. */
int page_capture(const char *device, double seconds);

/* As in web/page_probe.h; of a lab that has solutions, exactly is what the first draws. */
const char *page_probe(int column, int row);
const char *page_names(void);
const char *page_show(const char *what);

/* RGBA, row 0 at the top. */
const unsigned char *page_pixels(void);
int page_width(void);
int page_height(void);

/* Closes the lab and its canvas, also when WebGL has lost it. */
void page_close(void);

#endif
