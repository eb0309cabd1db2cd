/* The yardstick: what a careful C programmer writes. One Bresenham line from the robot
   to each pixel on the rim of its reach; every pixel is marked once as empty or
   object and counted into its cell. Whole numbers wherever they will do, -O3. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const unsigned char *wall;
    int height, width, reach_squared;
    int *stamp;             /* 1 + reading that marked each pixel last */
    int *cell_row, *cell_col;
    int (*counts)[2];       /* empty and object pixels of each cell */
    int *touched;
    int n_touched;
} Map;

static inline void mark(Map *m, int row, int col, int pixel, int reading, int is_object)
{
    if (m->stamp[pixel] == reading) return;
    m->stamp[pixel] = reading;
    int cell = m->cell_row[row] + m->cell_col[col];
    int *counts = m->counts[cell];
    if (counts[0] + counts[1] == 0) m->touched[m->n_touched++] = cell;
    counts[is_object]++;
}

static void walk(Map *m, int x0, int y0, int dx, int dy, int reading)
{
    int step_x = dx > 0 ? 1 : -1, step_y = dy > 0 ? 1 : -1;
    int across = abs(dx), down = -abs(dy);
    int error = across + down, hit = 0, x = 0, y = 0;
    while (x * x + y * y <= m->reach_squared) {
        int col = x0 + x, row = y0 + y;
        if (col < 0 || row < 0 || col >= m->width || row >= m->height) return;
        int pixel = row * m->width + col;
        hit |= m->wall[pixel];
        mark(m, row, col, pixel, reading, hit);
        int twice = 2 * error;
        if (twice >= down) { error += down; x += step_x; }
        if (twice <= across) { error += across; y += step_y; }
    }
}

/* Returns the number of entries written to cell and log_odds. */
long collect(const unsigned char *wall, int height, int width, const double *poses,
             int n_poses, double range, double fov, int cell_px, int *cell,
             double *log_odds)
{
    int n_cols = (width + cell_px - 1) / cell_px;
    int n_cells = n_cols * ((height + cell_px - 1) / cell_px);
    int rim = (int)ceil(range), n_rim = 8 * rim;
    size_t pixels = (size_t)height * width;
    Map m = {wall, height, width, (int)(range * range),
             calloc(pixels, sizeof(int)), malloc(height * sizeof(int)),
             malloc(width * sizeof(int)), calloc(n_cells, sizeof(int[2])),
             malloc(n_cells * sizeof(int)), 0};
    int (*to)[2] = malloc(n_rim * sizeof(int[2]));
    double *bearing = malloc(n_rim * sizeof(double));
    long n = 0;

    for (int i = 0; i < height; i++) m.cell_row[i] = i / cell_px * n_cols;
    for (int i = 0; i < width; i++) m.cell_col[i] = i / cell_px;
    for (int i = 0; i < 2 * rim; i++) {
        int k = i - rim, sides[4][2] = {{k, -rim}, {rim, k}, {-k, rim}, {-rim, -k}};
        memcpy(to + 4 * i, sides, sizeof sides);
    }
    for (int i = 0; i < n_rim; i++) bearing[i] = atan2(to[i][1], to[i][0]);

    for (int i = 0; i < n_poses; i++) {
        const double *pose = poses + 3 * i;
        int x = (int)floor(pose[0]), y = (int)floor(pose[1]);
        double theta = remainder(pose[2], 2 * M_PI);
        m.n_touched = 0;
        for (int k = 0; k < n_rim; k++) {
            double off = fabs(bearing[k] - theta);
            if (off > M_PI) off = 2 * M_PI - off;
            if (off <= fov / 2) walk(&m, x, y, to[k][0], to[k][1], i + 1);
        }
        for (int j = 0; j < m.n_touched; j++, n++) {
            int *counts = m.counts[m.touched[j]];
            double q = (double)counts[0] / (counts[0] + counts[1]);
            double p = q < 0.1 ? 0.1 : q > 0.9 ? 0.9 : q;
            cell[n] = m.touched[j];
            log_odds[n] = log(p / (1 - p));
            counts[0] = counts[1] = 0;
        }
    }
    free(m.stamp); free(m.cell_row); free(m.cell_col); free(m.counts); free(m.touched);
    free(to); free(bearing);
    return n;
}
