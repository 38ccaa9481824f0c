/* carvel.h - skeleton */
#ifndef CARVEL_H
#define CARVEL_H
#define CARVEL_VERSION_MAJOR 0
#define CARVEL_VERSION_MINOR 1
#define CARVEL_VERSION_PATCH 0
#ifdef __cplusplus
extern "C" {
#endif
const char *carvel_version(void);
#ifdef __cplusplus
}
#endif
#endif
