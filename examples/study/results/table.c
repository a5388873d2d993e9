#include "study/results/table.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

void table_open(Table *table, const char *head)
{
    table->last_left = false;
    output_text_open(&table->rows);
    table_row(table, "%s", head);
}

void table_row(Table *table, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vfprintf(table->rows.file, format, arguments);
    va_end(arguments);
    fputc('\n', table->rows.file);
}

static int cell_width(const char *cell)
{
    return (int)strcspn(cell, "|\n");
}

/* NULL after the last one of a row. */
static const char *next_cell(const char *cell)
{
    cell += cell_width(cell);
    return *cell == '|' ? cell + 1 : NULL;
}

static void put_markdown(const char *row, bool head, FILE *file)
{
    for (const char *cell = row; cell; cell = next_cell(cell))
        fprintf(file, "| %.*s ", cell_width(cell), cell);
    fputs("|\n", file);
    for (const char *cell = row; head && cell; cell = next_cell(cell))
        fputs("|---", file);
    fputs(head ? "|\n" : "", file);
}

static void put_aligned(const char *row, const int widths[TABLE_MAX_COLUMNS], bool last_left,
                        FILE *file)
{
    int column = 0;
    for (const char *cell = row; cell; cell = next_cell(cell), column++) {
        const int right = last_left && !next_cell(cell) ? 0 : widths[column];
        fprintf(file, "%s%*.*s", column ? "  " : "", column ? right : -widths[0], cell_width(cell),
                cell);
    }
    fputc('\n', file);
}

void table_close(Table *table, bool markdown, FILE *file)
{
    int widths[TABLE_MAX_COLUMNS] = {0};
    char *const text = output_text_close(&table->rows), *const end = text + table->rows.size;
    for (const char *row = text; row < end; row = strchr(row, '\n') + 1) {
        int column = 0;
        for (const char *cell = row; cell; cell = next_cell(cell), column++)
            widths[column] = cell_width(cell) > widths[column] ? cell_width(cell) : widths[column];
    }
    for (const char *row = text; row < end; row = strchr(row, '\n') + 1) {
        if (markdown)
            put_markdown(row, row == text, file);
        else
            put_aligned(row, widths, table->last_left, file);
    }
    free(text);
}

void table_machine(const char *driver, FILE *file)
{
    char line[256], processor[200] = "unknown processor";
    const char *threads = getenv("LP_NUM_THREADS");
    FILE *information = fopen("/proc/cpuinfo", "r");
    while (information && fgets(line, sizeof line, information))
        if (sscanf(line, "model name : %199[^\n]", processor) == 1)
            break;
    if (information)
        fclose(information);
    fprintf(file, "%s, %ld cores; ", processor, sysconf(_SC_NPROCESSORS_ONLN));
    if (driver)
        fprintf(file, "%s; LP_NUM_THREADS %s; ", driver,
                threads && threads[0] ? threads : "default");
    fprintf(file, "%s\n", COMPILER);
}
