/* Three threads that sleep at the same time. */
#include <pthread.h>

#include "client.h"

static unsigned long ends[3];

static void *sleeper(void *at)
{
    for (int i = 0; i < 10; i++)
        usleep(100000);
    *(unsigned long *)at = drycut_milliseconds();
    return NULL;
}

int main(void)
{
    pthread_t threads[3];
    unsigned long began;
    GT_Open(65535);
    began = drycut_milliseconds();
    for (int i = 0; i < 3; i++)
        pthread_create(&threads[i], NULL, sleeper, &ends[i]);
    for (int i = 0; i < 3; i++)
        pthread_join(threads[i], NULL);
    printf("3 threads of 10 sleeps of 100 ms: %g s\n", (double)(drycut_milliseconds() - began) / 1000.0);
    printf("ends in order: %d\n", ends[0] <= ends[1] && ends[1] <= ends[2]);
    return GT_Close();
}
