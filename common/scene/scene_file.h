/*
 * scene_file: what a file of a scene holds: nodes, meshes, materials, lights, cameras. No GL.
 *
 * glTF 2.0, OBJ and PLY are read by us, all other formats by Assimp, in the plugin and in a child
 * process with limited time and memory, because damaged files can make a reader loop or crash.
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include "scene/scene.h"

/* Limits. Vertices count before equal ones are merged. */
enum {
    MODEL_BYTES_MAX = 1 << 30,
    MODEL_VERTICES_MAX = 10000000,
    MODEL_TRIANGLES_MAX = 20000000,
    FILE_ITEMS_MAX = 100000, /* nodes, objects, lights... of a kind */
    FILE_KEYS_MAX = 10000000,
    FILE_NAME = 48,
};

/* The axis of the file that points up. MODEL_UP_FILE: the one that the file names (FBX, COLLADA),
 * or its format's custom: z for STL, 3DS and Blender, y for all others. */
typedef enum ModelUp { MODEL_UP_FILE, MODEL_UP_X, MODEL_UP_Y, MODEL_UP_Z } ModelUp;

typedef struct FileNode {
    int parent; /* an earlier node; -1: the world */
    Mat4 parent_from_node;
    bool moving; /* channels change these, of which the matrix is made then */
    Vec3 translation, scale;
    Vec4 rotation; /* a quaternion */
} FileNode;

/* One mesh at one node: without a mesh and a matrix, which follow from those. */
typedef struct FileObject {
    Object object;
    int node, mesh;
    char name[FILE_NAME];
} FileObject;

/* In its node's space. */
typedef struct FileLight {
    Light light;
    int node; /* -1: as it is */
    char name[FILE_NAME];
} FileLight;

typedef struct FileCamera {
    Camera camera;                          /* far 0: as the scene needs it */
    double half_height;                     /* of an orthographic view; 0: it is none */
    int node;                               /* -1: as it is */
    char name[FILE_NAME], place[FILE_NAME]; /* its own and its node's */
} FileCamera;

/* What changes of a node, by time. */
typedef enum FilePath { FILE_TRANSLATION, FILE_ROTATION, FILE_SCALE } FilePath;
typedef enum FileStep { FILE_LINEAR, FILE_STEP, FILE_CUBIC } FileStep;
typedef struct FileChannel {
    int node, path, step, count;
    int first; /* in the keys: `count` times; then 3 or 4 numbers for each, of FILE_CUBIC three
                  times as many */
} FileChannel;

/* What of the file is not drawn, and how often it occurs. */
typedef struct FileNote {
    char text[120];
    int count;
} FileNote;

typedef struct SceneFile {
    Scene scene;      /* all else of it, as its colours are meant; without lights and objects */
    bool photometric; /* lights are in candela and lux, or watts: above 1 */
    bool own;         /* written by us: nothing of it is to be chosen */
    bool turns;       /* its first node, the world, is yet to be turned as the user says */
    FileNode *nodes;
    FileObject *objects;
    FileLight *lights;
    FileCamera *cameras;
    FileChannel *channels;
    float *keys;
    FileNote *notes;
    Mesh *meshes;
    int node_count, object_count, light_count, camera_count, channel_count, key_count, note_count,
        mesh_count;
} SceneFile;

/* Reads a file. Numbers of meshes are finite, indices in range, triangles have an area; normals are
 * normalized, and zero where the file has none. `up` turns it so that y points up.
 *
 * Fails, with a message of one line and a zeroed file, if the file cannot be read, is none, is
 * damaged (as far as its format shows) or too large. */
bool scene_file_read(const char *path, ModelUp up, SceneFile *file, Message *message);

/* Where nodes are at a time: of each, world_from_node. Until 0 they rest, and then the animation
 * begins, again and again. */
void scene_file_pose(const SceneFile *file, double seconds, Mat4 *world_from_nodes);

/* The rotation that turns an axis, 0 to 2, or its opposite, to y. */
Mat4 scene_file_upright(int axis, bool down);

/* A node's matrix from what channels change. */
Mat4 scene_file_moved(const FileNode *node);

/* Of a file that is made: one more item, zeroed, of one of its lists; NULL, with the reason: there
 * are too many. */
typedef enum FileList {
    FILE_NODES,
    FILE_OBJECTS,
    FILE_LIGHTS,
    FILE_CAMERAS,
    FILE_CHANNELS,
    FILE_KEYS,
    FILE_NOTES,
    FILE_MESHES,
    FILE_LISTS,
} FileList;
void *scene_file_add(SceneFile *file, FileList list, Message *reason);

/* Adds a channel, whose `first` is set here; its times and so many numbers are to be filled in. */
float *scene_file_add_channel(SceneFile *file, FileChannel channel, size_t numbers,
                              Message *reason);

/* Whether so many vertices and indices are read; else with the reason. */
bool scene_file_fits(size_t vertices, size_t indices, Message *reason);

/* What a list holds, where it begins, how many items it has, the bytes of one and the most there
 * may be. */
typedef struct FileListPlace {
    const char *name;
    void **items;
    int *count;
    size_t size;
    int most;
} FileListPlace;
FileListPlace scene_file_list(SceneFile *file, FileList list);

/* Counts one more of what is not drawn, if it occurs. */
void scene_file_note(SceneFile *file, bool occurs, const char *text);
#define NOTE_MEAN "textures of the base colour: their mean colour"
#define NOTE_TEXTURES "textures of all but the base colour: left out"
#define NOTE_TRANSPARENT "transparency: drawn opaque"
#define NOTE_LINES "points and lines: left out"
#define NOTE_SKIN "skins: the mesh as it rests"
#define NOTE_MORPH "morph targets: the mesh as it rests"
#define NOTE_AREA "lights with an area: as points"
#define NOTE_ANIMATION "animations after the first: left out"
#define NOTE_SPOT "soft edges of spot lights: fitted by an exponent"
#define NOTE_ORTHOGRAPHIC "orthographic cameras: from far away"
#define NOTE_INSTANCES "instances of EXT_mesh_gpu_instancing: one of them"
#define NOTE_METAL "metals with colours at the vertices: as no metals"
#define NOTE_UNLIT "unlit materials with colours at the vertices: lit"
#define NOTE_OUTSIDE "files outside its folder: refused"

/* The exponent of a spot whose light fades between these angles from its axis, in radians: as
 * strong as the file's where that is half as strong. */
double scene_file_spot_exponent(double inner, double outer);

/* Whether all of a mesh is its outside: its triangles' edges come in pairs of opposite directions,
 * and each connected part holds a volume. */
bool scene_file_is_closed(const Mesh *mesh);

/* Leaves triangles with an area; normals are of length 1, or 0. */
void scene_file_tidy(Mesh *mesh);

/* NULL or zeroed is fine. */
void scene_file_close(SceneFile *file);

#endif
