; The tank bench of the paper (section "Planning Domain Modeling"): a vehicle carries liquid from a supplier to
; distributors, whose clients draw it off. One level is one tenth of a reservoir.
; Every level that moves is the amount of a leveltransf object, as in the paper's class diagram.
(define (domain tank-bench)
  (:requirements :typing :negative-preconditions :equality :numeric-fluents)
  (:types
    vehicle place client leveltransf - object
    supplier distributor - place)
  (:predicates
    (is-at ?v - vehicle ?p - place)
    (serves ?d - distributor ?c - client))
  (:functions
    (lev ?v - vehicle)                     ; on board now
    (maxlevel ?v - vehicle)
    (critical ?v - vehicle)                ; the vehicle is never emptied below this
    (level ?d - distributor)
    (critical-level ?d - distributor)      ; a distributor releases down to this only
    (max-level ?d - distributor)
    (amount ?l - leveltransf)
    (distance ?a ?b - place)
    (demand ?c - client)
    (received ?c - client)
    (distance-travelled)
    (transport-cost)                       ; distance x level on board, as the paper accounts for its Figures 15 and 16
    (postponed))                           ; units of demand that a partial order left open

  (:action load
    :parameters (?v - vehicle ?f - supplier ?l - leveltransf)
    :precondition (and (is-at ?v ?f)
                       (<= (+ (lev ?v) (amount ?l)) (maxlevel ?v)))
    :effect (increase (lev ?v) (amount ?l)))

  (:action move
    :parameters (?v - vehicle ?from ?to - place)
    :precondition (and (is-at ?v ?from) (not (= ?from ?to)))
    :effect (and (not (is-at ?v ?from)) (is-at ?v ?to)
                 (increase (distance-travelled) (distance ?from ?to))
                 (increase (transport-cost) (* (distance ?from ?to) (lev ?v)))))

  (:action unload
    :parameters (?v - vehicle ?d - distributor ?l - leveltransf)
    :precondition (and (is-at ?v ?d)
                       (>= (- (lev ?v) (amount ?l)) (critical ?v))
                       (<= (+ (level ?d) (amount ?l)) (max-level ?d)))
    :effect (and (decrease (lev ?v) (amount ?l))
                 (increase (level ?d) (amount ?l))))

  ; The whole demand at once.
  (:action complete_order
    :parameters (?d - distributor ?c - client ?l - leveltransf)
    :precondition (and (serves ?d ?c)
                       (= (received ?c) 0)
                       (= (amount ?l) (demand ?c))
                       (>= (- (level ?d) (amount ?l)) (critical-level ?d)))
    :effect (and (decrease (level ?d) (amount ?l))
                 (increase (received ?c) (amount ?l))))

  ; Less than what is wanted; the rest is postponed and paid for.
  (:action partial_order
    :parameters (?d - distributor ?c - client ?l - leveltransf)
    :precondition (and (serves ?d ?c)
                       (< (amount ?l) (- (demand ?c) (received ?c)))
                       (>= (- (level ?d) (amount ?l)) (critical-level ?d)))
    :effect (and (decrease (level ?d) (amount ?l))
                 (increase (received ?c) (amount ?l))
                 (increase (postponed) (- (- (demand ?c) (received ?c)) (amount ?l)))))

  ; What a partial order left.
  (:action final_order
    :parameters (?d - distributor ?c - client ?l - leveltransf)
    :precondition (and (serves ?d ?c)
                       (> (received ?c) 0)
                       (= (amount ?l) (- (demand ?c) (received ?c)))
                       (>= (- (level ?d) (amount ?l)) (critical-level ?d)))
    :effect (and (decrease (level ?d) (amount ?l))
                 (increase (received ?c) (amount ?l)))))
