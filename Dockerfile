# docker build -t polybed . ; then, in the folder of a case:
# docker run --rm -v "$PWD:/bed" polybed tfm case.toml
FROM debian:12 AS build
COPY . /polybed
WORKDIR /polybed
# Debian's packages to compile, and those of the documentation, which the package contains.
RUN apt-get update \
    && apt-get install -y --no-install-recommends $(cat cmake/packages.txt) dpkg-dev file python3-sphinx python3-myst-parser furo libjs-mathjax \
    && cmake --preset release -DPOLYBED_TESTS=OFF \
    && cd build && cpack

FROM debian:12
COPY --from=build /polybed/build/*.deb /polybed.deb
RUN apt-get update \
    && apt-get install -y --no-install-recommends /polybed.deb \
    && rm -rf /polybed.deb /var/lib/apt/lists/*
WORKDIR /bed
ENTRYPOINT ["polybed"]
