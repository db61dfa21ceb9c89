/* Counts what a rank sends: preloaded (LD_PRELOAD), it stands between any program and MPI, libraries included. At
   MPI_Finalize each rank writes one line to the file named by MPI_COUNTS, its rank behind a dot:
   messages, bytes, collective calls. */
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>

static long long messages, bytes, collectives;

static void count(int number, MPI_Datatype type) {
  int size = 0;
  MPI_Type_size(type, &size);
  ++messages;
  bytes += (long long)number * size;
}

int MPI_Isend(const void* data, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request) {
  count(number, type);
  return PMPI_Isend(data, number, type, to, tag, comm, request);
}

int MPI_Send(const void* data, int number, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
  count(number, type);
  return PMPI_Send(data, number, type, to, tag, comm);
}

int MPI_Allreduce(const void* in, void* out, int number, MPI_Datatype type, MPI_Op op, MPI_Comm comm) {
  ++collectives;
  return PMPI_Allreduce(in, out, number, type, op, comm);
}

int MPI_Alltoall(const void* out, int n_out, MPI_Datatype t_out, void* in, int n_in, MPI_Datatype t_in, MPI_Comm comm) {
  ++collectives;
  return PMPI_Alltoall(out, n_out, t_out, in, n_in, t_in, comm);
}

int MPI_Bcast(void* data, int number, MPI_Datatype type, int root, MPI_Comm comm) {
  ++collectives;
  return PMPI_Bcast(data, number, type, root, comm);
}

int MPI_Allgather(const void* in, int n_in, MPI_Datatype t_in, void* out, int n_out, MPI_Datatype t_out, MPI_Comm comm) {
  ++collectives;
  return PMPI_Allgather(in, n_in, t_in, out, n_out, t_out, comm);
}

int MPI_Finalize(void) {
  const char* pattern = getenv("MPI_COUNTS");
  char path[4096];
  int rank = 0;
  FILE* file;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (pattern != NULL) {
    snprintf(path, sizeof path, "%s.%d", pattern, rank);
    file = fopen(path, "w");
    if (file != NULL) {
      fprintf(file, "%lld %lld %lld\n", messages, bytes, collectives);
      fclose(file);
    }
  }
  return PMPI_Finalize();
}
