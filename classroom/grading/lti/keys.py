"""RSA key pair that authenticates this program to an LMS; the private key stays on this machine."""

import os

from classroom.grading.term.course_file import TermError
from slamlab.extras import needs

KEY_BITS = 2048


class LtiError(TermError):
    """The services of the LMS cannot be used; the message states why."""


def library():
    """Import the libraries of the extra ``lti``: authlib (client, assertions), joserfc (keys)."""
    with needs("lti", "slam-course"):
        import authlib.integrations.requests_client as client
        from authlib.oauth2 import rfc7523
        from joserfc import jwk
    return client, rfc7523, jwk


def load_key(file, make=False):
    """Load the private RSA key (PEM); ``make`` creates a missing key that only its owner can read.
    Raises LtiError.
    """
    *_, jwk = library()
    from joserfc.errors import JoseError

    try:
        if make and not file.exists():
            made = jwk.RSAKey.generate_key(KEY_BITS)
            handle = os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
            with os.fdopen(handle, "wb") as stream:
                stream.write(made.as_pem(private=True))
        found = jwk.RSAKey.import_key(file.read_bytes())
        if not found.is_private:
            raise LtiError(f"{file} is a public key; the private one is needed")
        return found
    except OSError as error:
        message = f"{error.strerror}. Create a key with slamlab grade lti key"
        raise LtiError(f"the key {file} cannot be read: {message}") from None
    except (JoseError, ValueError, TypeError) as error:
        raise LtiError(f"{file} is not an RSA key in PEM format: {error}") from None


def public_key(key):
    """Return the public key as JWK (dict) and PEM (str)."""
    use = {"use": "sig", "alg": "RS256", "kid": key.thumbprint()}
    return key.as_dict(private=False) | use, key.as_pem(private=False).decode()
