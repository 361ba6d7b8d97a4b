/* A PI controller moves the slider of scenarios/controlled.json to 150 nm, with a look ahead by saving and restoring the state. */
#include "stickslip.h"

#include <stdio.h>
#include <stdlib.h>

static int failed(const char *what)
{
    fprintf(stderr, "%s: %s\n", what, stickslip_error());
    return 1;
}

static char *read_file(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    long size = -1;
    if (file != NULL && fseek(file, 0, SEEK_END) == 0 && (size = ftell(file)) >= 0 && fseek(file, 0, SEEK_SET) == 0)
        text = (char *)malloc((size_t)size + 1);
    *length = text == NULL ? 0 : fread(text, 1, (size_t)size, file);
    if (file != NULL)
        fclose(file);
    return text;
}

int main(int argc, char **argv)
{
    const double step = 50e-6, target = 150e-9, range = 1e-6;
    double integral = 0.0, position = 0.0, ahead = 0.0;
    uint32_t drive = 0, x = 0;
    uint8_t *state = NULL;
    size_t length = 0, size = 0;
    stickslip *plant = NULL;
    char *text = argc > 1 ? read_file(argv[1], &length) : NULL;
    int status, k;

    if (text == NULL) {
        fprintf(stderr, "usage: controller scenarios/controlled.json\n");
        return 2;
    }
    status = stickslip_create(text, length, &plant);
    free(text);
    if (status != 0 || stickslip_find(plant, "drive", &drive) != 0 || stickslip_find(plant, "slider.x", &x) != 0)
        return failed("scenario");
    for (k = 1; k <= 400; k++) {
        double error, command;
        if (stickslip_get(plant, x, &position) != 0)
            return failed("slider.x");
        error = target - position;
        integral += 1000.0 * error * step;
        command = 0.1 * error + integral;
        command = command < -range ? -range : command > range ? range : command;
        if (stickslip_set(plant, drive, command) != 0 || stickslip_advance(plant, k * step) != 0)
            return failed("step");
        if (k == 200) {
            /* What will the slider do if the drive stays? The state is restored afterwards. */
            size = stickslip_state_size(plant);
            state = (uint8_t *)malloc(size);
            if (state == NULL || stickslip_save(plant, state, size) != 0 || stickslip_advance(plant, 2.0 * k * step) != 0 ||
                stickslip_get(plant, x, &ahead) != 0 || stickslip_restore(plant, state, size) != 0)
                return failed("look ahead");
            free(state);
        }
        if (k % 40 == 0)
            printf("%.1f ms: slider at %.2f nm, drive at %.2f nm\n", 1e3 * k * step, 1e9 * position, 1e9 * command);
    }
    printf("without control from 10 ms on it would have stood at %.2f nm\n", 1e9 * ahead);
    stickslip_free(plant);
    return 0;
}
