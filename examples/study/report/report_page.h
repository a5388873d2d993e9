/*
 * report_page: a study as an HTML page that needs no network and no scripts.
 */
#ifndef REPORT_PAGE_H
#define REPORT_PAGE_H

#include "study/report/conclusions.h"

/* FOLDER/index.html: for each scene, by its number, a sentence and its plot; then the conclusions,
 * the plots of findings, and tables of efficient settings. Plots and sheets are linked if they are
 * in the folder. */
bool report_page(const Results *results, const int *scenes, int count,
                 const Conclusions *conclusions, const char *folder, Message *message);

#endif
