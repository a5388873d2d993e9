/*
 * results_fuzz: no file of results may do harm.
 *
 * The input is read as a file, and again as the rows below a header as it is written.
 */
#include "fuzz/fuzz.h"
#include "study/results/results.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerInitialize(int *count, char ***arguments);

static const char START[] =
    "scene,interpolation,divisions,precision,normals,guards,highlight,viewer,lights,samples,"
    "supersample,output,matrices,order,width,height,interior_rms,interior_maximum,all_rms,"
    "all_maximum,interior_pixels,time,time_lower,time_upper,run_1,run_2,run_3,net_time,gpu_time,"
    "noise,vertices,fragments,vertex_operations,fragment_operations,seed,renderer,threads\n"
    "sphere,phong,64,highp,unit,on,cosine,local,local,0,1,nearest,double,eye,400,400,0.2,0.5,3,90,"
    "66000,2,1.9,2.1,2,2,2,1.4,,0.03,2048,66300,20,84,42,\"llvmpipe (LLVM 15, 256 bits)\","
    "\"default\"\n";

/* Complaints about rows would be most of what is said. libFuzzer keeps the stream that it had. */
int LLVMFuzzerInitialize(int *count, char ***arguments)
{
    (void)count;
    (void)arguments;
    stderr = fopen("/dev/null", "w");
    return stderr ? 0 : 1;
}

static void check_row(const ResultRow *row)
{
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        require(row->quality.choice[axis] < QUALITY_AXES[axis].count);
    require(row->scene[0] && !strchr(row->scene, '/') && row->width >= 1 && row->height >= 1 &&
            row->vertices >= -1 && row->vertex_operations >= -1 && !isinf(row->time) &&
            !(row->time < 0) && strlen(row->renderer) < sizeof row->renderer);
}

static int read_text(const char *text, size_t size, const ResultRow *like)
{
    Results results = {0};
    Message message = {0};
    require(results_parse(&results, "fuzzed.csv", text, size, like, &message) == !message.text[0]);
    for (int i = 0; i < results.count; i++)
        check_row(&results.rows[i]);
    const int count = results.count;
    results_close(&results);
    return count;
}

FUZZ(data, size)
{
    const ResultRow like = {.width = 400,
                            .height = 400,
                            .renderer = "llvmpipe (LLVM 15, 256 bits)",
                            .threads = "default"};
    const size_t start = strlen(START);
    char *text = malloc(start + size + 1);
    if (!text)
        return 0;
    memcpy(text, START, start);
    if (size)
        memcpy(text + start, data, size);
    read_text(text + start, size, NULL);
    /* Whatever follows a row, it stays. */
    require(read_text(text, start + size, NULL) >= 1 && read_text(text, start + size, &like) >= 1);
    /* Changed bytes within the row itself, at places that the input names. */
    const size_t header = (size_t)(strchr(START, '\n') - START) + 1;
    for (size_t i = 0; i + 1 < size && i < 8; i += 2)
        text[header + data[i] % (start - header)] = (char)data[i + 1];
    read_text(text, start, NULL);
    free(text);
    return 0;
}
